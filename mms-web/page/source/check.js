// The panel "Check": the verdict, then the lines that `mms check` prints, then warnings.
import { errorBox, make, table } from "./dom.js";
import { wording } from "./editor.js";

const count = (number, word) => `${number} ${word}${number === 1 ? "" : "s"}`;

/** Makes one line of the check a row: its word, and the rest. */
function row(line) {
  const [, word, rest] = line.match(/^ {2}(\S+) +(.*)$/) ?? [null, "", line.trim()];
  const bad = /REFUTED|not proved|differs|undefined|unknown/i.test(rest);
  return [word, make("span", { className: bad ? "bad" : "" }, rest)];
}

/** Shows the result of a check in `panel`, and returns its verdict in a few words. */
export function showCheck(panel, result) {
  const warned = result.warnings.length;
  const verdict = (result.passes ? "The field passes" : "The field does not pass") + (warned ? `, with ${count(warned, "warning")}` : "");
  const [title, ...lines] = result.text.trimEnd().split("\n");
  panel.replaceChildren(
    make("p", { className: result.passes ? "verdict good" : "verdict wrong" }, verdict),
    make("p", {}, title),
    table([], lines.filter(Boolean).map(row), "Lines of the check"),
    warned ? make("h3", {}, "Warnings") : "",
    make("ul", {}, result.warnings.map((warning) => make("li", { className: "lines" }, wording(warning)))),
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
