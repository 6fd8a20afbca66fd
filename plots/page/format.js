// Values with units, as the terminal's table shows them; the unit of a quantity ends its key.

const isError = (key) => data.errors.includes(key);

// Three digits, without trailing zeros.
const digits = (value) => String(Number(value.toPrecision(3)));

function seconds(value) {
  if (value < 1e-3) return `${digits(value * 1e6)} µs`;
  if (value < 1) return `${digits(value * 1e3)} ms`;
  return `${digits(value)} s`;
}

const MEBIBYTE = 1024 * 1024;
const bytes = (value) => `${(value / MEBIBYTE).toFixed(1)} MiB`;
// In which values are round numbers; seconds are so in any of their units.
const unitOf = (key) => (key.endsWith("_bytes") ? MEBIBYTE : 1);

// 1.1e-12; two digits of the exponent at least.
const exponential = (value) => value.toExponential(1).replace(/e([+-])(\d)$/, "e$10$2");

const grouped = (value) =>
    (Number.isInteger(value) ? String(value).replace(/\B(?=(\d{3})+$)/g, "\u202f") : digits(value));

function show(key, value) {
  if (value === null || value === undefined) return "–";
  if (typeof value !== "number") return String(value);
  if (isError(key)) return exponential(value);
  if (key.endsWith("_s")) return seconds(value);
  if (key.endsWith("_bytes")) return bytes(value);
  return grouped(value);
}

// Short, for an axis: 12M operations.
function showShort(key, value) {
  if (isError(key)) return exponential(value).replace(/^1\.0/, "1");
  if (key.endsWith("_bytes")) return `${digits(value / MEBIBYTE)} MiB`;
  if (key.endsWith("_s") || Math.abs(value) < 1e5) return show(key, value);
  for (const [size, letter] of [[1e12, "T"], [1e9, "G"], [1e6, "M"], [1e3, "k"]])
    if (Math.abs(value) >= size) return digits(value / size) + letter;
  return grouped(value);
}

// "+2.3 %" from one value to the next, "× 12" where that says more; empty: no ratio.
function step(key, before, after) {
  if (!before || after === null || after === undefined) return "";
  const percent = 100 * (after / before - 1), size = Math.abs(percent);
  if (percent === 0) return "unchanged";
  if (isError(key) || size >= 1000) return `× ${digits(after / before)}`;
  if (size < 0.05) return "< 0.1 %";
  return `${percent > 0 ? "+" : "−"}${size.toFixed(size < 10 ? 1 : 0)} %`;
}

const day = (date) => date.slice(0, 10);
const shortRevision = (revision) => revision.slice(0, 7);
const counted = (count, noun) => `${count} ${noun}${count === 1 ? "" : "s"}`;
const GLYPHS = {worse: "▲", better: "▼", changed: "◆"};

// An element with attributes and children; text stays text.
function element(name, attributes = {}, ...children) {
  return fill(document.createElement(name), attributes, children);
}

function drawn(name, attributes = {}, ...children) {
  return fill(document.createElementNS("http://www.w3.org/2000/svg", name), attributes, children);
}

function fill(node, attributes, children) {
  for (const [key, value] of Object.entries(attributes))
    if (value !== null && value !== undefined && value !== false) node.setAttribute(key, value);
  node.append(...children.filter((child) => child !== null));
  return node;
}
