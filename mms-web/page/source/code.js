// The panel "Code": the source of the field in a language, with its check program.
import { strToU8, zipSync } from "fflate";
import { copy, download, make } from "./dom.js";

/** @param {import("./main.js").Page} page */
export function codePanel(panel, page) {
  const target = make("select", { onchange: () => page.refresh() });
  const doc = make("p", { className: "quiet" });
  const boxes = make("div", { className: "boxes" });
  const summary = make("summary", {}, "Quantities: all");
  const all = make("button", { type: "button", onclick: () => choose([]) }, "All");
  const file = make("select", { onchange: () => showFile() });
  const code = make("pre", { className: "code", tabIndex: 0, role: "region", ariaLabel: "Code" });
  const verify = make("div", {});
  const act = (label, action) => make("button", { type: "button", onclick: action }, label);
  panel.append(
    make("div", { className: "bar" }, make("label", {}, "Language ", target)),
    doc,
    make("details", {}, summary, make("fieldset", {}, make("legend", {}, "None chosen means all, with the domain and the material"), all, boxes)),
    make(
      "div",
      { className: "bar" },
      make("label", {}, "File ", file),
      act("Copy", async () => page.say((await copy(shownFile().text)) ? "Copied" : "This browser does not let the page copy")),
      act("Download", () => download(shownFile().name, shownFile().text)),
      act("All files (zip)", zip),
    ),
    code,
    verify,
  );

  let files = [];
  let targets = [];
  let offered = "";
  const chosen = () => [...boxes.querySelectorAll("input:checked")].map((box) => box.value);
  const shownFile = () => files.find(({ name }) => name === file.value) ?? files[0] ?? { name: "", text: "" };

  function choose(names) {
    for (const box of boxes.querySelectorAll("input")) box.checked = names.includes(box.value);
    page.refresh();
  }

  function zip() {
    const folder = page.source().name;
    const entries = files.map(({ name, text }) => [`${folder}/${name}`, strToU8(text)]);
    entries.push([`${folder}/${folder}.toml`, strToU8(page.source().text)]);
    download(`${folder}.zip`, zipSync(Object.fromEntries(entries)), "application/zip");
  }

  function showFile() {
    code.textContent = shownFile().text;
  }

  /** Fills both lists anew if the choices have changed; otherwise a focused box stays unchanged. */
  async function fill() {
    const answer = await page.ask("the languages", { do: "targets", ...page.source() });
    if (offered === JSON.stringify(answer)) return;
    offered = JSON.stringify(answer);
    targets = answer.targets;
    const [kept, marked] = [target.value || "c", chosen()];
    target.replaceChildren(...targets.map(({ name }) => make("option", { value: name }, name)));
    target.value = targets.some(({ name }) => name === kept) ? kept : targets[0]?.name;
    boxes.replaceChildren(
      ...answer.quantities.map(({ name, symbol, doc: meaning }) => {
        const box = make("input", { type: "checkbox", value: name, checked: marked.includes(name), onchange: () => page.refresh() });
        return make("label", { title: meaning ?? "" }, box, ` ${name.replaceAll("_", " ")}${symbol && symbol !== name ? ` (${symbol})` : ""}`);
      }),
    );
  }

  return async () => {
    await fill();
    const quantities = chosen();
    summary.textContent = `Quantities: ${quantities.length ? quantities.join(", ") : "all"}`;
    doc.textContent = targets.find(({ name }) => name === target.value)?.doc ?? "";
    const answer = await page.ask("the code", { do: "emit", ...page.source(), target: target.value, quantities });
    files = answer.files;
    const kept = file.value;
    file.replaceChildren(...files.map(({ name }) => make("option", { value: name }, name)));
    if (files.some(({ name }) => name === kept)) file.value = kept;
    verify.replaceChildren(
      ...(answer.verify ? [make("h3", {}, "To check your build"), make("pre", { className: "command" }, answer.verify)] : []),
    );
    showFile();
  };
}
