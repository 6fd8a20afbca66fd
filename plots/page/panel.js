// One case in a box: its name, its last value, its chart, and what the pointer tells.

// A line may break after : and , in a method's name.
const breakable = (name) =>
    name.split(/(?<=[:,])/).flatMap((piece, k) => (k ? [element("wbr"), piece] : [piece]));

// data-* attributes say what the panel shows.
function panel(title, where, key, series, nights, marks) {
  const {values} = series;
  const {svg, x, axis} = chart(key, series, nights, marks);
  const last = values[values.length - 1],
        before = values.length > 1 ? values[values.length - 2] : null;
  svg.setAttribute(
      "aria-label", `${title} ${where}: ${show(key, last)} in the last of ${nights.length} nights`);
  const now = element("span", {class: "now"}, show(key, last));
  const box = element(
      "article", {class: "panel", "data-case": series.name, "data-quantity": key},
      element(
          "header", {}, element("h3", {}, ...breakable(title)), now,
          element("span", {class: "where"}, where),
          element(
              "span", {class: "step", title: "against the night before"}, step(key, before, last))),
      svg);
  followPointer(svg, nights.length, x, axis, values, (k) => tipText(key, series, nights, marks, k));
  return box;
}

// Date and revision, value and interval, what is not ok, what changed: a line each.
function tipText(key, {values, low, high, status}, nights, marks, k) {
  const lines = [`${day(nights[k].date)}  ${shortRevision(nights[k].revision)}`];
  const bounded = low && high && Number.isFinite(low[k]) && Number.isFinite(high[k]);
  const interval = bounded ? `  (${show(key, low[k])} to ${show(key, high[k])})` : "";
  lines.push(show(key, values[k]) + interval);
  if (status[k] && status[k] !== "ok") lines.push(status[k].replace(/_/g, " "));
  for (const mark of marks)
    if (mark.night === k) lines.push(`${GLYPHS[mark.kind]} ${mark.sentence}`);
  return lines.join("\n");
}

// A line and the value of the night nearest to the pointer; arrow keys step from night to night.
function followPointer(svg, count, x, axis, values, words) {
  const tip = document.getElementById("tip");
  let night = count - 1, shown = [];
  const hide = () => {
    shown.forEach((part) => part.remove());
    shown = [];
    tip.hidden = true;
  };
  const move = (k) => {
    hide();
    night = k;
    shown = [drawn(
        "line", {class: "cursor", x1: x(k), x2: x(k), y1: BOX.top, y2: BOX.height - BOX.bottom})];
    if (axis && axis.inside(values[k]))
      shown.push(drawn("circle", {class: "point", cx: x(k), cy: axis.y(values[k]), r: 4}));
    svg.append(...shown);
    tip.textContent = words(k);
    tip.hidden = false;
    const box = svg.getBoundingClientRect(), at = box.left + box.width * x(k) / BOX.width;
    tip.style.left = `${Math.max(4, Math.min(at + 10, innerWidth - tip.offsetWidth - 8))}px`;
    tip.style.top = `${Math.max(4, box.top - tip.offsetHeight - 4)}px`;
  };
  const inside = (k) => Math.max(0, Math.min(count - 1, k));
  svg.addEventListener("pointermove", (event) => {
    const box = svg.getBoundingClientRect();
    const at = (event.clientX - box.left) * BOX.width / box.width;
    const apart = (x(count - 1) - x(0)) / (count - 1) || 1;
    move(inside(Math.round((at - x(0)) / apart)));
  });
  svg.addEventListener("pointerleave", hide);
  svg.addEventListener("blur", hide);
  svg.addEventListener("keydown", (event) => {
    const to = {ArrowLeft: night - 1, ArrowRight: night + 1, Home: 0, End: count - 1}[event.key];
    if (event.key === "Escape") hide();
    if (to === undefined) return;
    event.preventDefault();
    move(inside(to));
  });
}
