// What is shown is in the address, #filter=HYBRID&sort=-time_s&quantity=peak_heap_bytes, so that a
// view can be sent to somebody.

const DEFAULTS = {
  filter: "",
  sort: "",
  quantity: "time_s"
};

// What the address does not know, or the page does not have, is as by default.
function readState(data) {
  const found = new URLSearchParams(location.hash.slice(1));
  const state = {...DEFAULTS};
  for (const key of Object.keys(DEFAULTS))
    if (found.has(key)) state[key] = found.get(key);
  const sortable = data.columns.some((column) => column.key === state.sort.replace(/^-/, ""));
  if (!sortable) state.sort = "";
  if (!data.quantities.some((quantity) => quantity.key === state.quantity))
    state.quantity = data.quantities.length ? data.quantities[0].key : "";
  return state;
}

function fragment(state) {
  const parts = new URLSearchParams();
  for (const [key, value] of Object.entries(state))
    if (value !== DEFAULTS[key]) parts.set(key, value);
  return `#${parts}`;
}

const writeState = (state) => history.replaceState(null, "", fragment(state));

// What cases are filtered by. The case's name ends with a slash, so that "3STEPD/" is not
// 3STEPD:LEAN.
const wordsOf = (one) => `${one.name}/ ${one.family} ${one.body}`;

// All words must be found, in any order and case.
function matcher(filter) {
  const words = filter.toLowerCase().split(/\s+/).filter(Boolean);
  return (text) => words.every((word) => text.toLowerCase().includes(word));
}
