// The cases of the last run, error against time, on logarithmic axes: a point each, open where it is not ok.

const PLOT = {width: 760, height: 400, left: 80, right: 728, top: 14, bottom: 352};
const TICK_EVERY = {x: 6, y: 8};  // labels at most

// A logarithmic axis of whole decades around the values: place, ticks.
function decadeAxis(values, from, to, most) {
  const low = Math.floor(Math.log10(Math.min(...values)) - 0.02);
  const high = Math.max(Math.ceil(Math.log10(Math.max(...values)) + 0.02), low + 1);
  const every = Math.ceil((high - low) / most), ticks = [];
  for (let k = low; k <= high; k += every) ticks.push(10 ** k);
  return {at: (value) => from + (to - from) * (Math.log10(value) - low) / (high - low), ticks};
}

function scatterAxes(x, y, error) {
  const label = (attributes, words) => drawn("text", attributes, words);
  return [
    ...x.ticks.flatMap((tick) => [
      vertical(x.at(tick), PLOT.top, PLOT.bottom, {class: "grid"}),
      label({x: x.at(tick), y: PLOT.bottom + 16, "text-anchor": "middle"}, showShort("time_s", tick))
    ]),
    ...y.ticks.flatMap((tick) => [
      drawn("line", {class: "grid", x1: PLOT.left, x2: PLOT.right, y1: y.at(tick), y2: y.at(tick)}),
      label({x: PLOT.left - 6, y: y.at(tick) + 4, "text-anchor": "end"}, showShort(error, tick))
    ]),
    label({x: (PLOT.left + PLOT.right) / 2, y: PLOT.bottom + 36, "text-anchor": "middle"}, "time of one solve")
  ];
}

const caseText = (row, error) => [
  row.name, `${show("time_s", row.time_s)}, ${nameOf(error)} ${show(error, row[error])}`,
  ...(row.status === "ok" ? [] : [row.status.replace(/_/g, " ")])
].join("\n");

const nameOf = (key) => data.columns.find((column) => column.key === key).name;

// Points in the order of their times, which arrow keys follow.
function fillScatter(rows, error) {
  const points = sorted(rows.filter((row) => row.time_s > 0 && row[error] > 0), "time_s", 1);
  const words = `${points.length} of ${rows.length} cases shown have a time and this error, above 0.`;
  const legend = [element("span", {}, `${words} Open: not ok. A colour is a method. `)];
  document.getElementById("scatter-legend").replaceChildren(...legend, ...Object.entries(
      Object.fromEntries(points.map((row) => [row.method, row.colour]))).flatMap(([method, colour]) => {
    const spot = drawn("svg", {viewBox: "0 0 10 10", class: "spot", "aria-hidden": "true"},
                       drawn("circle", {cx: 5, cy: 5, r: 4, fill: colour}));
    return [element("span", {class: "method"}, spot, method), " "];
  }));
  const place = document.getElementById("plot");
  if (!points.length) return place.replaceChildren();
  const x = decadeAxis(points.map((row) => row.time_s), PLOT.left, PLOT.right, TICK_EVERY.x);
  const y = decadeAxis(points.map((row) => row[error]), PLOT.bottom, PLOT.top, TICK_EVERY.y);
  const at = (row) => [x.at(row.time_s), y.at(row[error])];
  const svg = drawn(
      "svg", {
        viewBox: `0 0 ${PLOT.width} ${PLOT.height}`,
        role: "img",
        tabindex: 0,
        "aria-label": `${nameOf(error)} against time, ${points.length} cases; arrow keys go from case to case`
      },
      ...scatterAxes(x, y, error),
      ...points.map((row) => {
        const [cx, cy] = at(row), fill = row.status === "ok" ? row.colour : "none";
        return drawn("circle", {class: "case", cx, cy, r: 4.5, fill, stroke: row.colour, "data-case": row.name});
      }));
  const nearest = (event) => {
    const box = svg.getBoundingClientRect(), scale = PLOT.width / box.width;
    const [px, py] = [(event.clientX - box.left) * scale, (event.clientY - box.top) * scale];
    const distances = points.map((row) => Math.hypot(at(row)[0] - px, at(row)[1] - py));
    return distances.indexOf(Math.min(...distances));
  };
  followPoints(svg, points.length, PLOT, nearest, (k) => [at(points[k])[0], at(points[k])[1] - 10], (k) => caseText(points[k], error),
               (k) => [drawn("circle", {class: "chosen", cx: at(points[k])[0], cy: at(points[k])[1], r: 8})]);
  place.replaceChildren(svg);
}
