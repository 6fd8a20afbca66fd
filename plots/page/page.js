// Puts the page together, and again when what is shown changes.

const data = JSON.parse(document.getElementById("data").textContent);
const byId = (id) => document.getElementById(id);
let state = readState(data);

function headline() {
  const {failed, times_judged, verdicts, statuses} = data.last, night = data.nights[data.nights.length - 1];
  const ok = statuses.filter((status) => status === "ok").length;
  const worse = verdicts.filter((verdict) => verdict.kind === "worse").length;
  const words = failed ?
      `Failed${worse ? `: ${worse} ${worse === 1 ? "change" : "changes"} for the worse` : ""}` :
      verdicts.length ? "Passed, with changes" :
      times_judged    ? "Passed, nothing has changed" :
                        "Passed, times are not judged yet";
  const sentences = verdicts.map((verdict) => {
    const link = element(
        "a", {href: fragment({...state, filter: verdict.case === "all cases" ? "" : `${verdict.case}/`, quantity: verdict.quantity})},
        verdict.sentence);
    link.addEventListener("click", () => byId("history").scrollIntoView());
    return element(
        "li", {class: verdict.kind},
        element("b", {class: "glyph", title: verdict.kind}, GLYPHS[verdict.kind]), link);
  });
  byId("state").className = failed ? "failed" : "passed";
  byId("state").replaceChildren(
      element("h1", {}, words),
      element(
          "p", {class: "facts"},
          `Night of ${day(night.date)}, revision ${shortRevision(night.revision)}: ${ok} of ${
              statuses.length} cases ok; ${data.nights.length} ${
              data.nights.length === 1 ? "night" : "nights"} on record.`),
      ...(sentences.length ? [element("ul", {}, ...sentences)] : []));
}

function chooser() {
  const groups = {};
  for (const {key, name, group} of data.quantities)
    (groups[group] = groups[group] || []).push(element("option", {value: key}, name));
  byId("quantity")
      .replaceChildren(...Object.entries(groups).map(
          ([group, options]) => element("optgroup", {label: group}, ...options)));
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

function fillPanels() {
  const matches = matcher(state.filter), key = state.quantity;
  const shown = data.cases.filter((one) => matches(wordsOf(one)) && one.values[key]);
  const panels = data.bodies.flatMap((body) => {
    const own = shown.filter((one) => one.body === body).map((one) => {
      const bounds =
          key === "time_s" ? {low: one.values.time_low_s, high: one.values.time_high_s} : {};
      return panel(
          one.method, `${one.mesh} · ${one.scene}`, key,
          {name: one.name, values: one.values[key], status: one.status, ...bounds}, data.nights,
          marksOf(one.name, key));
    });
    return own.length && data.bodies.length > 1 ? [element("h3", {class: "body"}, body), ...own] :
                                                  own;
  });
  byId("panels").replaceChildren(...(panels.length ? panels : [
    element("p", {class: "none"}, "No case has both these words and this quantity.")
  ]));
  const log = isError(key) ? " The axis is logarithmic." : "";
  const band = key === "time_s" ? " Band: the interval of the median." : "";
  byId("legend").replaceChildren(
      `${shown.length} of ${data.cases.length} cases.${band}${log} Changes, where they began: `,
      ...["worse", "better", "changed"].flatMap(
          (kind) => [element("b", {class: `glyph ${kind}`}, GLYPHS[kind]), ` ${kind}  `]),
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
  for (const button of document.querySelectorAll("#pictures button"))
    button.addEventListener("click", () => {
      const large = byId("large");
      large.querySelectorAll("img").forEach((image) => image.remove());
      large.append(button.firstElementChild.cloneNode());
      large.showModal();
    });
  byId("large").addEventListener(
      "click", (event) => event.target === byId("large") && byId("large").close());
}

function update(change) {
  const old = state;
  state = {...state, ...change};
  if (byId("filter").value !== state.filter) byId("filter").value = state.filter;
  byId("quantity").value = state.quantity;
  if (change === undefined || old.filter !== state.filter || old.quantity !== state.quantity)
    fillPanels();
  if (change === undefined || old.filter !== state.filter || old.sort !== state.sort)
    fillTable(data, state, (sort) => update({sort}));
  writeState(state);
}

byId("figures").hidden = !byId("pictures").childElementCount;
headline();
chooser();
fillContext(data.context);
fillNoise();
enlarge();
byId("controls").addEventListener("submit", (event) => event.preventDefault());
byId("filter").addEventListener("input", (event) => update({filter: event.target.value}));
byId("quantity").addEventListener("change", (event) => update({quantity: event.target.value}));
addEventListener("hashchange", () => update(readState(data)));
update();
