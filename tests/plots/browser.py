"""A page as headless Chromium has it when its script has run."""
from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from html.parser import HTMLParser
from pathlib import Path

CHROMIUM = shutil.which("chromium") or shutil.which("google-chrome")
VOID = {"meta", "link", "input", "img", "br", "wbr"}


class Element:
    def __init__(self, name: str, attributes: dict) -> None:
        self.name, self.attributes, self.children, self.words = name, attributes, [], []

    def all(self, name: str, **wanted: str) -> list["Element"]:
        """Descendants; class_ is one of the classes."""
        found = []
        for child in self.children:
            of_class = wanted.get("class_", "") in (child.attributes.get("class") or "").split()
            others = {key.replace("_", "-"): value for key, value in wanted.items()
                      if key != "class_"}
            if child.name == name and (of_class or "class_" not in wanted) and \
                    others.items() <= child.attributes.items():
                found.append(child)
            found += child.all(name, **wanted)
        return found

    def one(self, name: str, **wanted: str) -> "Element":
        found = self.all(name, **wanted)
        assert len(found) == 1, f"{len(found)} of {name} {wanted}"
        return found[0]

    @property
    def text(self) -> str:
        return "".join(word if isinstance(word, str) else word.text for word in self.words)


class Document(HTMLParser):
    def __init__(self, text: str) -> None:
        super().__init__()
        self.open = [Element("", {})]
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list) -> None:
        element = Element(tag, dict(attrs))
        self.open[-1].children.append(element)
        self.open[-1].words.append(element)
        if tag not in VOID:
            self.open.append(element)

    def handle_endtag(self, tag: str) -> None:
        if tag not in VOID:
            self.open.pop()

    def handle_data(self, data: str) -> None:
        self.open[-1].words.append(data)


@dataclass
class View:
    document: Element
    console: list[str]   # what the page complained of
    requests: list[str]  # addresses on the network that it asked for


def browse(page: Path, fragment: str = "") -> View:
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        # No home to write to, and no display.
        environment = {key: value for key, value in os.environ.items()
                       if key not in ("HOME", "DISPLAY", "WAYLAND_DISPLAY")}
        done = subprocess.run(
            [CHROMIUM, "--headless=new", "--no-sandbox", "--disable-gpu",
             "--disable-dev-shm-usage", "--no-first-run", "--disable-background-networking",
             "--host-resolver-rules=MAP * ~NOTFOUND",  # nothing leaves this machine
             f"--user-data-dir={profile}", "--enable-logging=stderr", "--dump-dom",
             f"--log-net-log={profile}/net.json", "--virtual-time-budget=3000",
             f"{page.as_uri()}{fragment}"],
            env=environment | {"XDG_CONFIG_HOME": profile, "XDG_CACHE_HOME": profile},
            capture_output=True, text=True, timeout=120)
        if done.returncode != 0:
            raise RuntimeError(f"chromium ended with {done.returncode}: {done.stderr}")
        return View(Document(done.stdout).open[0], re.findall(r"CONSOLE.*", done.stderr),
                    requests_of_the_page(Path(profile) / "net.json"))


def requests_of_the_page(log: Path) -> list[str]:
    """Addresses on the network that a page asks for, by the browser's log; not its own."""
    urls = []
    for event in json.loads(log.read_text(encoding="utf-8"))["events"]:
        about = event.get("params") or {}
        if about.get("initiator", "not an origin") != "not an origin" and \
                re.match(r"(https?|wss?|ftp):", about.get("url", "")):
            urls.append(about["url"])
    return urls
