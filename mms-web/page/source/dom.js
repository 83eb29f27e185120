// Small helpers that make elements, show errors, copy and download.
import { wording } from "./editor.js";

/** Makes an element; `on...` properties are handlers, others attributes or properties. */
export function make(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (name in element && name !== "list") element[name] = value;
    else element.setAttribute(name, value);
  }
  element.append(...children.flat().filter((child) => child != null && child !== false));
  return element;
}

/** Makes a table of rows; the first cell of each row heads it. */
export function table(heads, rows, caption) {
  return make(
    "div",
    { className: "scroll", tabIndex: 0, role: "region", ariaLabel: caption },
    make(
      "table",
      {},
      make("caption", { className: "unseen" }, caption),
      heads.length ? make("thead", {}, make("tr", {}, heads.map((head) => make("th", { scope: "col" }, head)))) : null,
      make(
        "tbody",
        {},
        rows.map((row) => make("tr", {}, row.map((cell, column) => make(column ? "td" : "th", column ? {} : { scope: "row" }, cell)))),
      ),
    ),
  );
}

/** Shows an error of the module: its message, and diagnostics that are not part of the message. */
export function errorBox(error) {
  const untold = (error.diagnostics ?? []).filter((diagnostic) => !error.message.includes(diagnostic.message));
  const places = untold.map((diagnostic) => {
    const place = diagnostic.line == null ? "" : `${diagnostic.path ?? ""}:${diagnostic.line}:${diagnostic.column} `;
    return make("li", {}, place + wording(diagnostic));
  });
  const message = make(error.message.includes("\n") ? "pre" : "p", {}, error.message);
  return make("div", { className: "error" }, message, places.length ? make("ul", {}, places) : null);
}

/** Writes a number with four digits. */
export function shown(value) {
  if (value == null || !Number.isFinite(value)) return "-";
  return String(Number(value.toPrecision(4)));
}

/** Saves bytes or text as a file. */
export function download(name, content, type = "text/plain") {
  const link = make("a", { href: URL.createObjectURL(new Blob([content], { type })), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/** Copies text; selects `field` where the browser forbids it. */
export async function copy(text, field) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    const helper = field ?? document.body.appendChild(make("textarea", { value: text }));
    helper.select();
    const done = document.execCommand("copy");
    if (!field) helper.remove();
    return done;
  }
}
