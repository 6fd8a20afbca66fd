// One case in a box: its name, its last value, its chart over the nights, and what the pointer
// tells. A chart is drawn from {key, series, nights, marks}; series: name, status, values, and low
// and high where there is an interval, a list over the nights each.

const BOX = {width: 340, height: 172, left: 58, right: 330, top: 14, bottom: 134};
const DATES = 148, REVISIONS = 165;  // of their words' feet
const FEW = 60;  // nights; with more of them points and ticks run into each other
const REVISION_WIDTH = 52, DATE_WIDTH = 66;
const FAR_FROM_ZERO = 0.5;  // the least value over the greatest
// A triangle up, down, or a diamond: the kind of a change without its colour.
const FLAGS = {
  worse: "M-5 4L0 -5L5 4Z",
  better: "M-5 -5L0 4L5 -5Z",
  changed: "M-5 0L0 -5L5 0L0 5Z"
};

const fits = (key, value) => value !== null && (!isError(key) || value > 0);
// Times of another machine are not compared.
const follows = (key, nights, k) =>
    k > 0 && (!key.endsWith("_s") || nights[k].machine === nights[k - 1].machine);

// Values to heights. Errors are on a logarithmic axis; other axes begin at zero or, where all values
// are far from it, above a break; they span a tenth of the values at least, so that noise does not
// look like a change.
function verticalAxis(key, values) {
  const logarithmic = isError(key), scale = logarithmic ? Math.log10 : (value) => value;
  const drawable = values.filter((value) => fits(key, value)).map(scale);
  if (!drawable.length) return null;
  let [low, top] = [Math.min(...drawable), Math.max(...drawable)];
  let broken = false;
  if (logarithmic) {
    [low, top] = [Math.floor(low - 0.05), Math.ceil(top + 0.05)];
  } else {
    const span = Math.max(top - low, 0.1 * Math.abs(top), Number.MIN_VALUE) || 1;
    const middle = (low + top) / 2;
    broken = low > FAR_FROM_ZERO * top;
    if (broken) [low, top] = [middle - 0.7 * span, middle + 0.62 * span];
    else [low, top] = [Math.min(0, low), top + 0.12 * span];
  }
  const y = (value) => BOX.bottom - (BOX.bottom - BOX.top) * (scale(value) - low) / (top - low);
  return {y, broken, ticks: logarithmic ? decades(low, top) : roundTicks(low, top, unitOf(key))};
}

function decades(low, top) {
  const every = Math.max(1, Math.ceil((top - low) / 4));
  const ticks = [];
  for (let exponent = low; exponent <= top; exponent += every) ticks.push(10 ** exponent);
  return ticks;
}

// Round in the unit that is shown; two at least, since a width is at most 2.5 times the one before it.
function roundTicks(low, top, unit) {
  const rough = (top - low) / unit / 5, power = 10 ** Math.floor(Math.log10(rough));
  const width = [1, 2, 5, 10].find((factor) => factor * power >= rough) * power * unit;
  const ticks = [];
  for (let k = Math.ceil(low / width); k * width <= top; ++k) ticks.push(k * width);
  return ticks;
}

const horizontal = (count) => (night) => count < 2 ?
    (BOX.left + BOX.right) / 2 :
    BOX.left + 6 + (BOX.right - BOX.left - 12) * night / (count - 1);

const path = (corners) =>
    corners.map(([x, y], k) => `${k ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`).join("");

const vertical = (at, top, bottom, attributes) =>
    drawn("line", {...attributes, x1: at, x2: at, y1: top, y2: bottom});

// Revisions below: the first, the last, and where something changed, as far as there is room.
function revisionLabels(nights, marks, x) {
  const last = nights.length - 1;
  const label = (night, anchor, kind) => drawn(
      "text", {x: x(night), y: REVISIONS, "text-anchor": anchor, class: kind},
      shortRevision(nights[night].revision));
  if (last === 0) return [label(0, "middle")];
  const labels = [label(0, "start")];
  let taken = x(0) + REVISION_WIDTH;
  for (const mark of [...marks].sort((a, b) => a.night - b.night)) {
    const left = x(mark.night) - REVISION_WIDTH / 2, right = left + REVISION_WIDTH;
    if (left < taken || right > x(last) - REVISION_WIDTH) continue;
    labels.push(label(mark.night, "middle", mark.kind));
    taken = right;
  }
  return [...labels, label(last, "end")];
}

// Dates: the first, the last, and one between them, where they have room; of one day also the times.
function dateLabels(nights, x) {
  const last = nights.length - 1, middle = Math.round(last / 2);
  const isOneDay = last > 0 && day(nights[0].date) === day(nights[last].date);
  const words = ({date}) => isOneDay ? date.slice(11, 16) : day(date);
  const label = (night, anchor) => drawn(
      "text", {x: x(night), y: DATES, "text-anchor": anchor, class: "date"},
      night === 0 && isOneDay ? `${day(nights[0].date)} ${words(nights[0])}` : words(nights[night]));
  if (last === 0) return [label(0, "middle")];
  const room = x(middle) - x(0) > 1.5 * DATE_WIDTH && x(last) - x(middle) > 1.5 * DATE_WIDTH;
  return [label(0, "start"), ...(room ? [label(middle, "middle")] : []), label(last, "end")];
}

// Two strokes across the axis, below which it does not go on to zero.
const breakOf = () => drawn("path", {
  class: "break",
  d: `M${BOX.left - 5} ${BOX.bottom - 3}l10 -5m-10 9l10 -5`
});

function gridAndTicks(key, axis, x, nights) {
  const lines = (axis ? axis.ticks : []).flatMap((tick) => {
    const y = axis.y(tick);
    return [
      drawn("line", {class: "grid", x1: BOX.left, x2: BOX.right, y1: y, y2: y}),
      drawn("text", {x: BOX.left - 6, y: y + 3.5, "text-anchor": "end"}, showShort(key, tick))
    ];
  });
  lines.push(vertical(BOX.left, BOX.top, BOX.bottom, {class: "axis"}));
  if (axis && axis.broken) lines.push(breakOf());
  const isNew = (night, k) => k === 0 || night.revision !== nights[k - 1].revision;
  if (nights.length <= FEW)
    nights.forEach((night, k) => {
      if (isNew(night, k)) lines.push(vertical(x(k), BOX.bottom, BOX.bottom + 4, {class: "tick"}));
    });
  return lines;
}

// The bands of the intervals and the lines, in stretches of nights without a gap, and the points.
function curves(key, axis, x, {values, low, high}, nights) {
  const stretches = [], at = (k, list) => [x(k), axis.y(list[k])];
  values.forEach((value, k) => {
    if (!fits(key, value)) return;
    if (!follows(key, nights, k) || !fits(key, values[k - 1])) stretches.push([]);
    stretches[stretches.length - 1].push(k);
  });
  const shapes = stretches.flatMap((stretch) => {
    const bounded = stretch.filter((k) => low && high && fits(key, low[k]) && fits(key, high[k]));
    const around = [
      ...bounded.map((k) => at(k, high)), ...bounded.map((k) => at(k, low)).reverse()
    ];
    // "h0" makes a dot of a single night.
    const line = drawn("path", {class: "curve", d: path(stretch.map((k) => at(k, values))) + "h0"});
    return bounded.length < 2 ? [line] :
                                [drawn("path", {class: "band", d: `${path(around)}Z`}), line];
  });
  const r = values.length > FEW / 2 ? 1.6 : 2.4;
  const points = values.length > FEW ? [] : stretches.flat().map(
      (k) => drawn("circle", {class: "point", cx: x(k), cy: axis.y(values[k]), r}));
  return [...shapes, ...points];
}

function failuresAndMarks(x, status, marks) {
  const isFailure = (word) => word && word !== "ok" && word !== "skipped";
  const failures = status.flatMap((word, k) => isFailure(word) ? [drawn("path", {
    class: "failure",
    "data-night": k,
    d: `M${x(k) - 3} ${BOX.bottom - 8}l6 6m0 -6l-6 6`
  })] : []);
  return [...failures, ...marks.flatMap((mark) => {
    const at = x(mark.night);
    return [
      vertical(at, BOX.top - 2, BOX.bottom, {
        class: `mark ${mark.kind}`,
        "data-since": mark.since,
        "data-night": mark.night
      }),
      drawn("path", {
        class: `flag ${mark.kind}`,
        d: FLAGS[mark.kind],
        transform: `translate(${at} ${BOX.top - 6})`
      })
    ];
  })];
}

// A line may break after : and , in a method's name.
const breakable = (name) =>
    name.split(/(?<=[:,])/).flatMap((piece, k) => (k ? [element("wbr"), piece] : [piece]));

// data-* attributes say what the panel shows.
function panel(title, where, key, series, nights, marks) {
  const {values} = series, newest = values.length - 1, last = values[newest];
  const before = follows(key, nights, newest) ? values[newest - 1] : null;
  const axis = verticalAxis(key, [...values, ...(series.low || []), ...(series.high || [])]);
  const x = horizontal(nights.length);
  const label = `${title} ${where}: ${show(key, last)} in the last of ${nights.length} nights`;
  const svg = drawn(
      "svg",
      {viewBox: `0 0 ${BOX.width} ${BOX.height}`, role: "img", tabindex: 0, "aria-label": label},
      ...gridAndTicks(key, axis, x, nights), ...dateLabels(nights, x),
      ...revisionLabels(nights, marks, x),
      ...(axis ? curves(key, axis, x, series, nights) : []), ...failuresAndMarks(x, series.status, marks));
  const nearest = (event) => {
    const box = svg.getBoundingClientRect();
    return Math.round(((event.clientX - box.left) * BOX.width / box.width - x(0)) / (x(1) - x(0) || 1));
  };
  followPoints(svg, nights.length, BOX, nearest, (k) => [x(k), 0], (k) => tipText(key, series, nights, marks, k), (k) => [
    vertical(x(k), BOX.top, BOX.bottom, {class: "cursor"}),
    ...(axis && fits(key, values[k]) ? [drawn("circle", {class: "point", cx: x(k), cy: axis.y(values[k]), r: 4})] : [])
  ]);
  return element(
      "article", {class: "panel", "data-case": series.name, "data-quantity": key},
      element(
          "header", {}, element("h3", {}, ...breakable(title)),
          element("span", {class: "now"}, show(key, last)), element("span", {class: "where"}, where),
          element(
              "span", {class: "step", title: "against the night before"}, step(key, before, last))),
      svg);
}

// Date and revision, value and interval, what is not ok, what changed: a line each.
function tipText(key, {values, low, high, status}, nights, marks, k) {
  const bounded = low && high && Number.isFinite(low[k]) && Number.isFinite(high[k]);
  const interval = bounded ? `  (${show(key, low[k])} to ${show(key, high[k])})` : "";
  return [
    `${day(nights[k].date)}  ${shortRevision(nights[k].revision)}`, show(key, values[k]) + interval,
    ...(status[k] && status[k] !== "ok" ? [status[k].replace(/_/g, " ")] : []),
    ...marks.filter((mark) => mark.night === k)
        .map((mark) => `${GLYPHS[mark.kind]} ${mark.sentence}`)
  ].join("\n");
}

// What is nearest to the pointer is marked and told; arrow keys step from one to the next.
// at: the place in the box above which it is told.
function followPoints(svg, count, box, nearest, at, words, marked) {
  const tip = document.getElementById("tip");
  let chosen = count - 1, shown = [];
  const hide = () => {
    shown.forEach((part) => part.remove());
    tip.hidden = true;
  };
  const move = (k) => {
    hide();
    chosen = Math.max(0, Math.min(count - 1, k));
    shown = marked(chosen);
    svg.append(...shown);
    tip.textContent = words(chosen);
    tip.hidden = false;
    const place = svg.getBoundingClientRect(), scale = place.width / box.width, [x, y] = at(chosen);
    tip.style.left = `${Math.max(4, Math.min(place.left + scale * x + 10, innerWidth - tip.offsetWidth - 8))}px`;
    tip.style.top = `${Math.max(4, place.top + scale * y - tip.offsetHeight - 4)}px`;
  };
  svg.addEventListener("pointermove", (event) => move(nearest(event)));
  svg.addEventListener("pointerleave", hide);
  svg.addEventListener("blur", hide);
  svg.addEventListener("keydown", (event) => {
    const to = {ArrowLeft: chosen - 1, ArrowRight: chosen + 1, Home: 0, End: count - 1}[event.key];
    if (event.key === "Escape") hide();
    if (to === undefined) return;
    event.preventDefault();
    move(to);
  });
}
