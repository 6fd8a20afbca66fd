// The drawing of one small chart: a quantity of a case over the nights.

const BOX = {
  width: 340,
  height: 158,
  left: 58,
  right: 10,
  top: 14,
  bottom: 24
};
const FEW = 60;  // nights; with more of them points and ticks run into each other

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
  return {
    y: (value) => (inside(value) ? y(value) : bottom),
    inside,
    ticks: logarithmic ? decades(low, top) : roundTicks(low, top, unitOf(key))
  };
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

const horizontal = (count) => (night) =>
    (count < 2 ? (BOX.left + BOX.width - BOX.right) / 2 :
                 BOX.left + 6 + (BOX.width - BOX.left - BOX.right - 12) * night / (count - 1));

// The nights that are drawn without a break.
function runs(values, inside) {
  const pieces = [[]];
  values.forEach((value, night) => {
    if (inside(value))
      pieces[pieces.length - 1].push(night);
    else if (pieces[pieces.length - 1].length)
      pieces.push([]);
  });
  return pieces.filter((piece) => piece.length);
}

const path = (corners) =>
    corners.map(([x, y], k) => `${k ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`).join("");

// A triangle up, down, or a diamond: the kind of a change without its colour.
function flag(mark, x) {
  const y = BOX.top - 6, shapes = {
    worse: [[-5, 4], [0, -5], [5, 4]],
    better: [[-5, -5], [0, 4], [5, -5]],
    changed: [[-5, 0], [0, -5], [5, 0], [0, 5]]
  };
  return drawn("path", {
    class: `flag ${mark.kind}`,
    d: `${path(shapes[mark.kind].map(([dx, dy]) => [x + dx, y + dy]))}Z`
  });
}

// Revisions below: the first, the last, and where something changed, as far as there is room.
function revisionLabels(nights, marks, x) {
  const y = BOX.height - 7, last = nights.length - 1, wide = 52;
  const label = (night, anchor, kind) => drawn(
      "text", {x: x(night), y, "text-anchor": anchor, class: kind},
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

function drawAxes(svg, key, axis, x, nights) {
  const bottom = BOX.height - BOX.bottom, right = BOX.width - BOX.right;
  for (const tick of axis ? axis.ticks : []) {
    const y = axis.y(tick);
    svg.append(
        drawn("line", {class: "grid", x1: BOX.left, x2: right, y1: y, y2: y}),
        drawn("text", {x: BOX.left - 6, y: y + 3.5, "text-anchor": "end"}, showShort(key, tick)));
  }
  if (nights.length > FEW) return;
  nights.forEach((night, k) => {
    if (k === 0 || night.revision !== nights[k - 1].revision)
      svg.append(drawn("line", {class: "tick", x1: x(k), x2: x(k), y1: bottom, y2: bottom + 4}));
  });
}

// One stretch of nights without a gap: the band of the intervals, and the line.
function drawCurve(svg, axis, x, nights, {values, low, high}) {
  const bounded = nights.filter(
      (k) => low && high && axis.inside(low[k]) && axis.inside(high[k]));
  const upper = bounded.map((k) => [x(k), axis.y(high[k])]);
  const lower = bounded.map((k) => [x(k), axis.y(low[k])]);
  if (bounded.length > 1)
    svg.append(drawn("path", {class: "band", d: `${path([...upper, ...lower.reverse()])}Z`}));
  // "h0" makes a dot of a single night.
  const line = path(nights.map((k) => [x(k), axis.y(values[k])])) + "h0";
  svg.append(drawn("path", {class: "curve", d: line}));
}

function drawPoints(svg, axis, x, values) {
  if (values.length > FEW) return;
  const r = values.length > FEW / 2 ? 1.6 : 2.4;
  values.forEach((value, k) => {
    if (axis.inside(value))
      svg.append(drawn("circle", {class: "point", cx: x(k), cy: axis.y(value), r}));
  });
}

function drawMarks(svg, x, status, marks) {
  const bottom = BOX.height - BOX.bottom;
  status.forEach((word, k) => {
    const cross = `M${x(k) - 3} ${bottom - 8}l6 6m0 -6l-6 6`;
    if (word && word !== "ok" && word !== "skipped")
      svg.append(drawn("path", {class: "failure", "data-night": k, d: cross}));
  });
  for (const mark of marks) {
    const at = x(mark.night);
    const place = {"data-since": mark.since, "data-night": mark.night};
    const line = {x1: at, x2: at, y1: BOX.top - 2, y2: bottom};
    svg.append(drawn("line", {class: `mark ${mark.kind}`, ...place, ...line}), flag(mark, at));
  }
}

// series: values, status, and low and high where there is an interval; a list over the nights each.
function chart(key, series, nights, marks) {
  const axis = verticalAxis(
      key, [...series.values, ...(series.low || []), ...(series.high || [])]);
  const x = horizontal(nights.length);
  const svg = drawn("svg", {viewBox: `0 0 ${BOX.width} ${BOX.height}`, role: "img", tabindex: 0});
  drawAxes(svg, key, axis, x, nights);
  svg.append(...revisionLabels(nights, marks, x));
  if (axis) {
    for (const piece of runs(series.values, axis.inside)) drawCurve(svg, axis, x, piece, series);
    drawPoints(svg, axis, x, series.values);
  }
  drawMarks(svg, x, series.status, marks);
  return {svg, x, axis};
}
