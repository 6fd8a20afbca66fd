// One small chart: a quantity of a case over the nights.

const BOX = {width: 340, height: 158, left: 58, right: 10, top: 14, bottom: 24};

// Values to heights. Errors are on a logarithmic axis; other axes span a tenth of the values at
// least, so that noise does not look like a change.
function verticalAxis(key, values) {
  const bottom = BOX.height - BOX.bottom, high = BOX.top;
  const logarithmic = isError(key);
  const drawable = values.filter((value) => value !== null && (!logarithmic || value > 0));
  if (!drawable.length) return null;
  const scale = logarithmic ? Math.log10 : (value) => value;
  let [low, top] = [Math.min(...drawable.map(scale)), Math.max(...drawable.map(scale))];
  if (logarithmic) {
    [low, top] = [Math.floor(low - 0.05), Math.ceil(top + 0.05)];
  } else {
    const span = Math.max(top - low, 0.1 * Math.abs(top), Number.MIN_VALUE) || 1;
    const middle = (low + top) / 2;
    const floor = drawable.every((value) => value >= 0) ? 0 : -Infinity;
    [low, top] = [Math.max(floor, middle - 0.62 * span), middle + 0.62 * span];
  }
  const y = (value) => bottom - (bottom - high) * (scale(value) - low) / (top - low);
  const inside = (value) => value !== null && (!logarithmic || value > 0);
  return {y: (value) => (inside(value) ? y(value) : bottom), inside,
          ticks: logarithmic ? decades(low, top) : roundTicks(low, top, unitOf(key))};
}

function decades(low, top) {
  const every = Math.max(1, Math.ceil((top - low) / 4));
  const ticks = [];
  for (let exponent = low; exponent <= top; exponent += every) ticks.push(10 ** exponent);
  return ticks;
}

// Round in the unit that is shown.
function roundTicks(low, top, unit) {
  const rough = (top - low) / unit / 4, power = 10 ** Math.floor(Math.log10(rough));
  const width = [1, 2, 5, 10].find((factor) => factor * power >= rough) * power * unit;
  const ticks = [];
  for (let k = Math.ceil(low / width); k * width <= top; ++k) ticks.push(k * width);
  return ticks;
}

const horizontal = (count) => (night) => (count < 2 ? (BOX.left + BOX.width - BOX.right) / 2
  : BOX.left + 6 + (BOX.width - BOX.left - BOX.right - 12) * night / (count - 1));

// The nights that are drawn without a break.
function runs(values, inside) {
  const pieces = [[]];
  values.forEach((value, night) => {
    if (inside(value)) pieces[pieces.length - 1].push(night);
    else if (pieces[pieces.length - 1].length) pieces.push([]);
  });
  return pieces.filter((piece) => piece.length);
}

const path = (corners) => corners.map(([x, y], k) => `${k ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`).join("");

// A triangle up, down, or a diamond: the kind of a change without its colour.
function flag(mark, x) {
  const y = BOX.top - 6, shapes = {worse: [[-5, 4], [0, -5], [5, 4]], better: [[-5, -5], [0, 4], [5, -5]],
                                   changed: [[-5, 0], [0, -5], [5, 0], [0, 5]]};
  return drawn("path", {class: `flag ${mark.kind}`,
                        d: `${path(shapes[mark.kind].map(([dx, dy]) => [x + dx, y + dy]))}Z`});
}

// Revisions below: the first, the last, and where something changed, as far as there is room.
function revisionLabels(nights, marks, x) {
  const y = BOX.height - 7, last = nights.length - 1, wide = 52;
  const label = (night, anchor, kind) => drawn("text", {x: x(night), y, "text-anchor": anchor, class: kind},
                                               shortRevision(nights[night].revision));
  if (last === 0) return [label(0, "middle")];
  const labels = [label(0, "start")], taken = [x(0) + wide];
  const ordered = [...marks].sort((a, b) => a.night - b.night);
  for (const mark of ordered) {
    const at = x(mark.night);
    if (at - wide / 2 < taken[taken.length - 1] || at + wide / 2 > x(last) - wide) continue;
    labels.push(label(mark.night, "middle", mark.kind));
    taken.push(at + wide / 2);
  }
  return [...labels, label(last, "end")];
}

function chart(key, values, low, high, status, nights, marks) {
  const axis = verticalAxis(key, [...values, ...(low || []), ...(high || [])]);
  const x = horizontal(nights.length), bottom = BOX.height - BOX.bottom, right = BOX.width - BOX.right;
  const svg = drawn("svg", {viewBox: `0 0 ${BOX.width} ${BOX.height}`, role: "img", tabindex: 0});
  for (const tick of axis ? axis.ticks : [])
    svg.append(drawn("line", {class: "grid", x1: BOX.left, x2: right, y1: axis.y(tick), y2: axis.y(tick)}),
               drawn("text", {x: BOX.left - 6, y: axis.y(tick) + 3.5, "text-anchor": "end"}, showShort(key, tick)));
  const few = nights.length <= 60;  // else points and ticks run into each other
  nights.forEach((night, k) => {
    if (few && (k === 0 || night.revision !== nights[k - 1].revision))
      svg.append(drawn("line", {class: "tick", x1: x(k), x2: x(k), y1: bottom, y2: bottom + 4}));
  });
  svg.append(...revisionLabels(nights, marks, x));
  if (axis) {
    for (const piece of runs(values, axis.inside)) {
      const bounded = low && high ? piece.filter((k) => axis.inside(low[k]) && axis.inside(high[k])) : [];
      if (bounded.length > 1)
        svg.append(drawn("path", {class: "band", d: `${path([...bounded.map((k) => [x(k), axis.y(high[k])]),
          ...bounded.reverse().map((k) => [x(k), axis.y(low[k])])])}Z`}));
      svg.append(drawn("path", {class: "curve", d: `${path(piece.map((k) => [x(k), axis.y(values[k])]))}h0`}));  // h0: a dot for one night
    }
    const radius = nights.length > 30 ? 1.6 : 2.4;
    values.forEach((value, k) => {
      if (few && axis.inside(value)) svg.append(drawn("circle", {class: "point", cx: x(k), cy: axis.y(value), r: radius}));
    });
  }
  status.forEach((word, k) => {
    if (word && word !== "ok" && word !== "skipped")
      svg.append(drawn("path", {class: "failure", "data-night": k, d: `M${x(k) - 3} ${bottom - 8}l6 6m0 -6l-6 6`}));
  });
  for (const mark of marks)
    svg.append(drawn("line", {class: `mark ${mark.kind}`, "data-since": mark.since, "data-night": mark.night,
                              x1: x(mark.night), x2: x(mark.night), y1: BOX.top - 2, y2: bottom}), flag(mark, x(mark.night)));
  return {svg, x, axis};
}

// A line may break after : and , in a method's name.
const breakable = (name) => name.split(/(?<=[:,])/).flatMap((piece, k) => (k ? [element("wbr"), piece] : [piece]));

// data-* attributes say what the panel shows.
function panel(title, where, key, series, nights, marks) {
  const {values, low, high, status} = series;
  const {svg, x, axis} = chart(key, values, low, high, status, nights, marks);
  const last = values[values.length - 1], before = values.length > 1 ? values[values.length - 2] : null;
  svg.setAttribute("aria-label", `${title} ${where}: ${show(key, last)} in the last of ${nights.length} nights`);
  const now = element("span", {class: "now"}, show(key, last));
  const box = element("article", {class: "panel", "data-case": series.name, "data-quantity": key},
    element("header", {}, element("h3", {}, ...breakable(title)), now, element("span", {class: "where"}, where),
            element("span", {class: "step", title: "against the night before"}, step(key, before, last))), svg);
  const words = (k) => [
    `${day(nights[k].date)}  ${shortRevision(nights[k].revision)}`,
    show(key, values[k]) + (low && high && low[k] != null && high[k] != null
      ? `  (${show(key, low[k])} to ${show(key, high[k])})` : ""),
    status[k] && status[k] !== "ok" ? status[k].replace(/_/g, " ") : "",
    ...marks.filter((mark) => mark.night === k).map((mark) => `${GLYPHS[mark.kind]} ${mark.sentence}`),
  ].filter(Boolean).join("\n");
  followPointer(svg, nights.length, x, axis, values, words);
  return box;
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
    shown = [drawn("line", {class: "cursor", x1: x(k), x2: x(k), y1: BOX.top, y2: BOX.height - BOX.bottom})];
    if (axis && axis.inside(values[k])) shown.push(drawn("circle", {class: "point", cx: x(k), cy: axis.y(values[k]), r: 4}));
    svg.append(...shown);
    tip.textContent = words(k);
    tip.hidden = false;
    const box = svg.getBoundingClientRect(), at = box.left + box.width * x(k) / BOX.width;
    tip.style.left = `${Math.max(4, Math.min(at + 10, innerWidth - tip.offsetWidth - 8))}px`;
    tip.style.top = `${Math.max(4, box.top - tip.offsetHeight - 4)}px`;
  };
  svg.addEventListener("pointermove", (event) => {
    const box = svg.getBoundingClientRect(), at = (event.clientX - box.left) * BOX.width / box.width;
    move(Math.max(0, Math.min(count - 1, Math.round((at - x(0)) / ((x(count - 1) - x(0)) / (count - 1) || 1)))));
  });
  svg.addEventListener("pointerleave", hide);
  svg.addEventListener("blur", hide);
  svg.addEventListener("keydown", (event) => {
    const to = {ArrowLeft: night - 1, ArrowRight: night + 1, Home: 0, End: count - 1}[event.key];
    if (event.key === "Escape") hide();
    if (to === undefined) return;
    event.preventDefault();
    move(Math.max(0, Math.min(count - 1, to)));
  });
}
