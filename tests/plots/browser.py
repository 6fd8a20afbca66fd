"""Pages as headless Chromium has them when their scripts have run."""
import json
import os
import re
import select
import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

CHROMIUM = shutil.which("chromium") or shutil.which("google-chrome")
NETWORK = r"(https?|wss?|ftp):"


class Element(ElementTree.Element):
    def all(self, name: str, class_: str = "", **wanted: str) -> list["Element"]:
        """Descendants; class_ is one of the classes."""
        others = {key.replace("_", "-"): value for key, value in wanted.items()}.items()
        return [child for child in self.iterfind(f".//{{*}}{name}") if others <= child.attrib.items()
                and (not class_ or class_ in child.get("class", "").split())]

    def one(self, name: str, **wanted: str) -> "Element":
        found = self.all(name, **wanted)
        assert len(found) == 1, f"{len(found)} of {name} {wanted}"
        return found[0]

    @property
    def words(self) -> str:
        return "".join(self.itertext())


def parsed(text: str) -> Element:
    builder = ElementTree.TreeBuilder(element_factory=Element)
    return ElementTree.fromstring(text, ElementTree.XMLParser(target=builder))


@dataclass
class View:
    document: Element
    console: list[str]   # what the page complained of
    requests: list[str]  # addresses on the network that it asked for


class Browser:
    """One headless Chromium for many views; speaks the DevTools protocol over a pipe."""

    def __init__(self) -> None:
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        folder = Path(self.profile.name)
        self.log = folder / "net.json"
        self.stderr = (folder / "stderr").open("w+", encoding="utf-8")
        # No home to write to, and no display.
        environment = {key: value for key, value in os.environ.items()
                       if key not in ("HOME", "DISPLAY", "WAYLAND_DISPLAY")}
        self.process = subprocess.Popen(  # it reads 3 and writes 4
            ["sh", "-c", 'exec "$@" 3<&0 4>&1 </dev/null >&2', "sh", CHROMIUM, "--headless=new",
             "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--no-first-run",
             "--disable-background-networking",
             "--host-resolver-rules=MAP * ~NOTFOUND",  # nothing leaves this machine
             f"--user-data-dir={folder}", f"--log-net-log={self.log}", "--remote-debugging-pipe",
             "about:blank"],  # not the page of a new tab, which asks for things of its own
            env=environment | {"XDG_CONFIG_HOME": str(folder), "XDG_CACHE_HOME": str(folder)},
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self.stderr)
        self.calls = 0
        self.asked: list[str] = []  # by all views
        self.unread = b""

    def close(self) -> None:
        """The browser's own log has the requests of its views, and no more."""
        self.call("Browser.close")
        status = self.process.wait(60)
        self.process.stdin.close()
        self.process.stdout.close()
        self.stderr.close()
        logged = requests_of_pages(self.log)
        self.profile.cleanup()
        if status != 0:
            raise RuntimeError(f"chromium ended with {status}")
        if set(logged) != set(self.asked):
            raise AssertionError(f"the views saw the requests {self.asked}, the log has {logged}")

    def message(self) -> dict:
        """The next one from the browser."""
        while b"\0" not in self.unread:
            pipe = self.process.stdout.fileno()
            piece = os.read(pipe, 1 << 20) if select.select([pipe], [], [], 120)[0] else b""
            if not piece:
                self.stderr.seek(0)
                raise RuntimeError(f"chromium has ended, or is silent: {self.stderr.read()}")
            self.unread += piece
        text, self.unread = self.unread.split(b"\0", 1)
        return json.loads(text)

    def call(self, method: str, session: str = "", events: list | None = None,
             **arguments: object) -> dict:
        """The answer; events that come before it are added."""
        self.calls += 1
        of_session = {"sessionId": session} if session else {}
        message = {"id": self.calls, "method": method, "params": arguments} | of_session
        self.process.stdin.write(json.dumps(message).encode() + b"\0")
        self.process.stdin.flush()
        while (message := self.message()).get("id") != self.calls:
            if events is not None:
                events.append(message)
        if "error" in message:
            raise RuntimeError(f"{method}: {message['error']}")
        return message["result"]

    def wait_for(self, events: list[dict], method: str, **params: str) -> None:
        while not any(event["method"] == method and params.items() <= event["params"].items()
                      for event in events):
            events.append(self.message())

    def browse(self, page: Path, fragment: str = "") -> View:
        """The page in a new tab, when 3 s of its time have passed."""
        events: list[dict] = []
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable", session)
        self.call("Page.setLifecycleEventsEnabled", session, enabled=True)
        url = page.as_uri() + fragment
        loader = self.call("Page.navigate", session, events, url=url)["loaderId"]
        self.wait_for(events, "Page.lifecycleEvent", name="load", loaderId=loader)
        self.call("Emulation.setVirtualTimePolicy", session, events, budget=3000,
                  policy="pauseIfNetworkFetchesPending")
        self.wait_for(events, "Emulation.virtualTimeBudgetExpired")
        text = self.call("Runtime.evaluate", session, events,
                         expression="new XMLSerializer().serializeToString(document)"
                         )["result"]["value"]
        self.call("Target.closeTarget", events=events, targetId=target)
        view = View(parsed(text), complaints(events), requests(events))
        self.asked += view.requests
        return view


def complaints(events: list[dict]) -> list[str]:
    """What the console of the page says."""
    return [json.dumps(event["params"]) for event in events if event["method"] in
            ("Log.entryAdded", "Runtime.consoleAPICalled", "Runtime.exceptionThrown")]


def requests(events: list[dict]) -> list[str]:
    """Addresses on the network that a page asks for, and that its policy does not forbid."""
    forbidden = {event["params"]["requestId"] for event in events
                 if event["method"] == "Network.loadingFailed"
                 and event["params"].get("blockedReason") == "csp"}
    urls = [event["params"]["request"]["url"] for event in events
            if event["method"] == "Network.requestWillBeSent"
            and event["params"]["requestId"] not in forbidden]
    return [url for url in urls if re.match(NETWORK, url)]


def requests_of_pages(log: Path) -> list[str]:
    """The same by the browser's log; not its own."""
    urls = []
    for event in json.loads(log.read_text(encoding="utf-8"))["events"]:
        about = event.get("params") or {}
        if about.get("initiator", "not an origin") != "not an origin" and \
                re.match(NETWORK, about.get("url", "")):
            urls.append(about["url"])
    return urls
