// Elements of a page, and the signs on buttons.

// Drawn, since not every machine's fonts have these signs.
const ICONS = {
  play: "M5 3l12 7-12 7z", pause: "M5 3h4v14H5zM11 3h4v14h-4z", start: "M4 3h3v14H4zM17 3v14L7 10z",
  back: "M13 4v12l-7-6zM14 4h2v12h-2z", on: "M7 4v12l7-6zM4 4h2v12H4z",
  full: "M3 3h5v2H5v3H3zM12 3h5v5h-2V5h-3zM3 12h2v3h3v2H3zM15 12h2v5h-5v-2h3z",
};

/** A sign as SVG. @param {string} name @returns {string} */
export function icon(name) {
  return `<svg viewBox="0 0 20 20" width="1em" height="1em" aria-hidden="true"><path fill="currentColor" d="${ICONS[name]}"/></svg>`;
}

// What takes the keys of whoever works it. JupyterLab looks from the element that has the focus
// upward for who wants a key, and takes it itself before it comes to our root: each has to say so.
const KEYED = new Set(["button", "input", "select"]);

/**
 * An element.
 * @param {string} tag @param {object} attributes "onclick" and its like listen, ".name" is a property
 * @param {(Node | string | null | undefined)[]} children @returns {HTMLElement}
 */
export function made(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  if (KEYED.has(tag)) element.setAttribute("data-lm-suppress-shortcuts", "true");
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (name.startsWith(".")) element[name.slice(1)] = value;
    else if (value !== false && value !== null) element.setAttribute(name, value === true ? "" : value);
  }
  element.append(...children.filter((c) => c !== null && c !== undefined));
  return element;
}
