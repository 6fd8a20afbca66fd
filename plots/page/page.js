// Puts the page together, and again when what is shown changes. What is shown is in the address,
// #filter=HYBRID&sort=-time_s&quantity=peak_heap_bytes, so that a view can be sent to somebody.

const data = JSON.parse(document.getElementById("data").textContent);
const byId = (id) => document.getElementById(id);
const DEFAULTS = {filter: "", sort: "", quantity: "time_s", error: data.scatter[0] || ""};
const isOneRun = !data.nights.length;
let state = readState();

// What the address does not know, or the page does not have, is as by default.
function readState() {
  const found = new URLSearchParams(location.hash.slice(1)), state = {...DEFAULTS};
  for (const key of Object.keys(DEFAULTS))
    if (found.has(key)) state[key] = found.get(key);
  if (!data.columns.some((column) => column.key === state.sort.replace(/^-/, ""))) state.sort = "";
  if (!data.quantities.some((quantity) => quantity.key === state.quantity))
    state.quantity = data.quantities.length ? data.quantities[0].key : "";
  if (!data.scatter.includes(state.error)) state.error = DEFAULTS.error;
  return state;
}

const fragment = (state) => `#${new URLSearchParams(
    Object.entries(state).filter(([key, value]) => value !== DEFAULTS[key]))}`;

// What cases are filtered by: all words must be found, in any order and case. The case's name ends
// with a slash, so that "3STEPD/" is not 3STEPD:LEAN.
function isShown(one, more = "") {
  const text = `${one.name}/ ${one.family} ${one.body} ${more}`.toLowerCase();
  return state.filter.toLowerCase().split(/\s+/).every((word) => text.includes(word));
}

const glyph = (kind, attributes = {}) =>
    element("b", {class: `glyph ${kind}`, ...attributes}, GLYPHS[kind]);

// Of a run without a history.
function headlineOfRun() {
  const ok = data.rows.filter((row) => row.status === "ok").length;
  byId("state").className = ok === data.rows.length ? "passed" : "failed";
  byId("state").replaceChildren(element("h1", {}, `${ok} of ${counted(data.rows.length, "case")} ok`));
}

function headline() {
  const {failed, times_judged, verdicts, statuses} = data.last, nights = data.nights;
  const night = nights[nights.length - 1];
  const ok = statuses.filter((status) => status === "ok").length;
  const worse = verdicts.filter((verdict) => verdict.kind === "worse").length;
  const words = failed ? `Failed${worse ? `: ${counted(worse, "change")} for the worse` : ""}` :
      verdicts.length  ? "Passed, with changes" :
      times_judged     ? "Passed, nothing has changed" :
                         "Passed, times are not judged yet";
  const sentences = verdicts.map(({quantity, kind, sentence, ...verdict}) => {
    const filter = verdict.case === "all cases" ? "" : `${verdict.case}/`;
    const link = element("a", {href: fragment({...state, filter, quantity})}, sentence);
    link.addEventListener("click", () => byId("history").scrollIntoView());
    return element(
        "li", {class: kind}, element("b", {class: "glyph", title: kind}, GLYPHS[kind]), link);
  });
  byId("state").className = failed ? "failed" : "passed";
  byId("state").replaceChildren(
      element("h1", {}, words),
      element(
          "p", {class: "facts"},
          `Night of ${day(night.date)}, revision ${shortRevision(night.revision)}: ${ok} of ${
              statuses.length} cases ok; ${counted(nights.length, "night")} on record.`),
      ...(sentences.length ? [element("ul", {}, ...sentences)] : []));
}

function chooser() {
  const groups = {};
  for (const {key, name, group} of data.quantities)
    (groups[group] = groups[group] || []).push(element("option", {value: key}, name));
  byId("quantity")
      .replaceChildren(...Object.entries(groups).map(
          ([label, options]) => element("optgroup", {label}, ...options)));
  byId("error").replaceChildren(...data.scatter.map((key) => element("option", {value: key}, nameOf(key))));
  byId("quantity").parentElement.hidden = isOneRun;
  byId("error").parentElement.hidden = data.scatter.length < 2;
  for (const section of document.querySelectorAll("main section:not([hidden])")) {
    const link = element("a", {href: "#"}, section.querySelector("h2").textContent);
    link.addEventListener("click", (event) => {
      event.preventDefault();  // the fragment holds the view, not a place
      section.scrollIntoView();
    });
    document.querySelector("#controls nav").append(link);
  }
}

// A change of status is marked whatever quantity is shown.
const marksOf = (name, key) => data.marks.filter(
    (mark) => mark.case === name && (mark.quantity === key || mark.lane === "status"));

function panelOf({name, method, mesh, scene, values, status}, key) {
  const bounds = key === "time_s" ? {low: values.time_low_s, high: values.time_high_s} : {};
  return panel(
      method, `${mesh} · ${scene}`, key, {name, values: values[key], status, ...bounds},
      data.nights, marksOf(name, key));
}

function fillPanels() {
  const key = state.quantity;
  const shown = data.cases.filter((one) => isShown(one) && one.values[key]);
  const panels = data.bodies.flatMap((body) => {
    const own = shown.filter((one) => one.body === body).map((one) => panelOf(one, key));
    return own.length && data.bodies.length > 1 ? [element("h3", {class: "body"}, body), ...own] :
                                                  own;
  });
  const none = element("p", {class: "none"}, "No case has both these words and this quantity.");
  byId("panels").replaceChildren(...(panels.length ? panels : [none]));
  const log = isError(key) ? " The axis is logarithmic." : "";
  const band = key === "time_s" ? " Band: the interval of the median." : "";
  byId("legend").replaceChildren(
      `${shown.length} of ${data.cases.length} cases.${band}${log} Changes, where they began: `,
      ...["worse", "better", "changed"].flatMap((kind) => [glyph(kind), ` ${kind}  `]),
      element("b", {class: "glyph worse"}, "✕"), " not ok");
}

function fillNoise() {
  const {median_s: values, mad_s: spread} = data.noise;
  if (values.every((value) => value === null)) return;
  const bound = (sign) => values.map(
      (value, k) => (value === null || spread[k] === null ? null : value + sign * spread[k]));
  byId("noise").replaceChildren(panel(
      "machine noise", "the same kernel every night", "noise_s",
      {name: "noise", values, low: bound(-1), high: bound(1), status: values.map(() => null)},
      data.nights, []));
}

function enlarge() {
  const large = byId("large");
  for (const button of document.querySelectorAll("#pictures button"))
    button.addEventListener("click", () => {
      large.querySelectorAll("img").forEach((image) => image.remove());
      large.append(button.firstElementChild.cloneNode());
      large.showModal();
    });
  large.addEventListener("click", (event) => event.target === large && large.close());
}

function update(change) {
  const old = state, isNew = (key) => change === undefined || old[key] !== state[key];
  state = {...state, ...change};
  if (byId("filter").value !== state.filter) byId("filter").value = state.filter;
  byId("quantity").value = state.quantity;
  byId("error").value = state.error;
  if (!isOneRun && (isNew("filter") || isNew("quantity"))) fillPanels();
  if (state.error && (isNew("filter") || isNew("error")))
    fillScatter(data.rows.filter((row) => isShown(row, row.status)), state.error);
  if (isNew("filter") || isNew("sort")) fillTable(data, state.sort, (sort) => update({sort}));
  history.replaceState(null, "", fragment(state));
}

byId("figures").hidden = !byId("pictures").childElementCount;
byId("scatter").hidden = !data.scatter.length;
byId("history").hidden = byId("compared").hidden = isOneRun;
byId("environment").hidden = !data.context.length;
isOneRun ? headlineOfRun() : headline();
chooser();
fillContext(data.context);
fillNoise();
enlarge();
byId("controls").addEventListener("submit", (event) => event.preventDefault());
byId("filter").addEventListener("input", (event) => update({filter: event.target.value}));
byId("quantity").addEventListener("change", (event) => update({quantity: event.target.value}));
byId("error").addEventListener("change", (event) => update({error: event.target.value}));
addEventListener("hashchange", () => update(readState()));
update();
