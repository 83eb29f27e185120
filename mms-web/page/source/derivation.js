// The panel "Derivation": each step from u to the body force, in MathML.
import { make } from "./dom.js";

/** @param {import("./main.js").Page} page */
export function derivationPanel(panel, page) {
  const choice = make("select", { onchange: () => page.refresh() }, make("option", { value: "" }, "displacement and body force"));
  const formulas = make("div", { className: "formulas", tabIndex: 0, role: "region", ariaLabel: "Derivation" });
  panel.append(make("div", { className: "bar" }, make("label", {}, "Quantity ", choice)), formulas);
  return async () => {
    const quantities = choice.value ? [choice.value] : [];
    const { html, quantities: names } = await page.ask("the derivation", { do: "derivation", ...page.source(), quantities });
    const chosen = choice.value;
    choice.replaceChildren(choice.options[0], ...names.map((name) => make("option", { value: name }, name.replaceAll("_", " "))));
    choice.value = names.includes(chosen) ? chosen : "";
    formulas.innerHTML = html;
  };
}
