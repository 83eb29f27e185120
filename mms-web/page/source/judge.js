// The panel "Judge": results of a solver, or a table of its errors, and what the verdict on them is.
import { copy, download, errorBox, make, shown, table } from "./dom.js";

const MOST = 1e9; // bytes of files that fit into the memory of a page beside what is made of them
const VERDICTS = /^(pass|exact to round-off|fail|not asymptotic|no evidence)\b/;

/** Reads numbers between commas or blanks; `1/8` is one, too. */
function numbers(text, what) {
  return text.split(/[\s,;]+/).filter(Boolean).map((word) => {
    const [above, below = "1", ...rest] = word.split("/");
    const value = Number(above) / Number(below);
    if (rest.length || !above || !Number.isFinite(value)) throw new Error(`${what}: \`${word}\` is no number. Write them as 0.25, 0.125 or 1/4, 1/8.`);
    return value;
  });
}

/** Splits a CSV file whose cells hold no quotes, and writes its numbers with four digits. */
const cells = (csv) =>
  csv.trimEnd().split("\n").map((line) => line.split(",").map((cell) => (/^-?\d.*\d$/.test(cell) ? shown(Number(cell)) : cell)));

/** @param {import("./main.js").Page} page */
export function judgePanel(panel, page) {
  let files = [];
  const input = make("input", { type: "file", multiple: true, id: "results", onchange: () => add(input.files) });
  const drop = make(
    "div",
    { className: "drop", ondragover: (event) => (event.preventDefault(), drop.classList.add("over")), ondragleave: () => drop.classList.remove("over") },
    make("label", { htmlFor: "results" }, "Drop result files here, one for each mesh, or a table of errors; or choose them:"),
    input,
  );
  drop.addEventListener("drop", (event) => {
    event.preventDefault();
    drop.classList.remove("over");
    add(event.dataTransfer.files);
  });
  const list = make("ol", { className: "files" });
  const kind = make("select", {}, make("option", { value: "results" }, "results of this field"), make("option", { value: "errors" }, "a table of errors"));
  const field = (placeholder) => make("input", { type: "text", placeholder, spellcheck: false, autocomplete: "off" });
  const sizes = field("1/8, 1/16, 1/32");
  const times = field("0.01");
  const quantities = field("u, sigma");
  const order = field("2");
  const go = make("button", { type: "submit", className: "main" }, "Judge");
  const verdict = make("div", { className: "judged" });
  const form = make(
    "form",
    { onsubmit: (event) => (event.preventDefault(), judge()) },
    drop,
    list,
    make(
      "div",
      { className: "fields" },
      make("label", {}, "The files are ", kind),
      make("label", {}, "Mesh sizes, in the order of the files ", sizes),
      make("label", {}, "Times, of files that hold none ", times),
      make("label", {}, "Quantities ", quantities),
      make("label", {}, "Expected order ", order),
    ),
    make("p", { className: "quiet" }, "Fields left empty are found in the files."),
    go,
  );
  panel.append(form, verdict);

  function add(chosen) {
    files = [...files.filter((file) => ![...chosen].some(({ name }) => name === file.name)), ...chosen];
    files.sort((one, other) => one.name.localeCompare(other.name, "en", { numeric: true }));
    input.value = "";
    showFiles();
  }

  function showFiles() {
    list.replaceChildren(
      ...files.map((file) =>
        make(
          "li",
          {},
          `${file.name} (${Math.ceil(file.size / 1000)} kB) `,
          make("button", { type: "button", ariaLabel: `Leave out ${file.name}`, onclick: () => ((files = files.filter((other) => other !== file)), showFiles()) }, "Leave out"),
        ),
      ),
    );
  }

  function options() {
    const words = quantities.value.split(/[\s,;]+/).filter(Boolean);
    const [expected] = numbers(order.value, "expected order");
    return {
      ...(kind.value === "errors" ? { errors: true } : {}),
      ...(sizes.value.trim() ? { mesh_sizes: numbers(sizes.value, "mesh sizes") } : {}),
      ...(times.value.trim() ? { times: numbers(times.value, "times") } : {}),
      ...(words.length ? { quantities: words } : {}),
      ...(expected === undefined ? {} : { expected_order: expected }),
    };
  }

  async function judge() {
    verdict.replaceChildren();
    await page.attempt(async () => {
      if (!files.length) throw new Error("there is no file yet. Drop the results of your solver, one file for each mesh.");
      const size = files.reduce((sum, file) => sum + file.size, 0);
      if (size > MOST) throw new Error(`the files have ${(size / 1e9).toFixed(1)} GB; a page takes at most ${MOST / 1e9} GB. Use the command mms judge.`);
      const header = { do: "judge", ...page.source(), options: options(), files: files.map(({ name, size }) => ({ name, size })) };
      const bytes = await Promise.all(files.map((file) => file.arrayBuffer()));
      show(await page.ask("the verdict", header, bytes));
    }, (error) => verdict.replaceChildren(errorBox(error)));
  }

  function show(result) {
    const first = result.text.split("\n").find((line) => VERDICTS.test(line)) ?? (result.passes ? "pass" : "no pass");
    const picture = make("img", { alt: `Errors over mesh size. ${first}`, src: URL.createObjectURL(new Blob([result.svg], { type: "image/svg+xml" })) });
    const [heads, ...rows] = cells(result.csv);
    const save = (label, name, content, type) => make("button", { type: "button", onclick: () => download(name, content, type) }, label);
    page.say(first);
    verdict.replaceChildren(
      make("p", { className: result.passes ? "verdict good" : "verdict wrong" }, first),
      ...(result.next
        ? [make("p", {}, "Next, with the command on your machine:"), make("pre", { className: "command" }, result.next), make("div", { className: "bar" }, make("button", { type: "button", onclick: () => copy(result.next) }, "Copy the command"))]
        : []),
      make("ul", {}, result.notes.map((note) => make("li", {}, note))),
      table(heads, rows, "Errors of each mesh"),
      result.svg ? make("figure", {}, picture) : "",
      make(
        "div",
        { className: "bar" },
        "Download ",
        save("JSON", "convergence.json", JSON.stringify(result.document, null, 2), "application/json"),
        save("CSV", "convergence.csv", result.csv, "text/csv"),
        save("Markdown", "convergence.md", result.markdown, "text/markdown"),
        save("LaTeX", "convergence.tex", result.latex),
        save("Picture", "convergence.svg", result.svg, "image/svg+xml"),
      ),
      make("details", { open: true }, make("summary", {}, "All that the command prints"), make("pre", { className: "code", tabIndex: 0 }, result.text)),
    );
  }
  // Judging waits for its button: nothing is to be made anew when the field changes.
  return null;
}
