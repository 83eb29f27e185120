// The panel "Check": the verdict, then claims that do not hold and warnings, then the lines that `mms check` prints.
import { errorBox, make, table } from "./dom.js";
import { wording } from "./editor.js";

const count = (number, word) => `${number} ${word}${number === 1 ? "" : "s"}`;

/** Makes one line of the check a row: its word, and the rest. Lines with a larger indent continue the one above. */
function row(line) {
  const [, word, rest] = line.match(/^ {2}(\S+) +(.*)$/) ?? [null, "", line.trim()];
  const bad = /REFUTED|FAILED|UNPROVED|NOT FINITE|NOT COMPARED/.test(rest);
  return [word, make("span", { className: bad ? "bad" : "" }, rest)];
}

function list(title, diagnostics) {
  if (!diagnostics.length) return [];
  return [make("h3", {}, title), make("ul", {}, diagnostics.map((diagnostic) => make("li", { className: "lines" }, wording(diagnostic))))];
}

/** Shows the result of a check in `panel`, and returns its verdict in a few words. */
export function showCheck(panel, result) {
  const warnings = result.warnings.filter(({ severity }) => severity === "warning");
  const objections = result.warnings.filter(({ severity }) => severity !== "warning");
  const verdict = (result.passes ? "The field passes" : "The field does not pass") + (warnings.length ? `, with ${count(warnings.length, "warning")}` : "");
  const [title, ...lines] = result.text.trimEnd().split("\n");
  panel.replaceChildren(
    make("p", { className: result.passes ? "verdict good" : "verdict wrong" }, verdict),
    make("p", {}, title),
    ...list("Objections", objections),
    ...list("Warnings", warnings),
    table([], lines.filter(Boolean).map(row), "Lines of the check"),
  );
  return verdict;
}

/** Shows why there is no check in `panel`, and returns it in a few words. */
export function showMistakes(panel, error) {
  const mistakes = error.diagnostics?.length ?? 0;
  const verdict = mistakes ? `The field has ${count(mistakes, "mistake")}` : "The check stopped";
  panel.replaceChildren(make("p", { className: "verdict wrong" }, verdict), errorBox(error));
  return verdict;
}
