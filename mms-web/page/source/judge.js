// The panel "Judge": results of a solver, or a table of its errors, and the verdict on them.
import { copy, download, errorBox, make, shown, table } from "./dom.js";
import { plot } from "./plot.js";

const MOST = 1e9; // bytes of files that fit into the memory of a page beside what is made of them
const GOOD = ["pass", "exact to round-off"];

/** Reads numbers between commas or blanks; `1/8` is one, too. */
function numbers(text, what) {
  return text.split(/[\s,;]+/).filter(Boolean).map((word) => {
    const [above, below = "1", ...rest] = word.split("/");
    const value = Number(above) / Number(below);
    if (rest.length || !above || !Number.isFinite(value)) throw new Error(`${what}: \`${word}\` is no number. Write them as 0.25, 0.125 or 1/4, 1/8.`);
    return value;
  });
}

const words = (name) => name.replaceAll("_", " ");

/** Writes a word as a shell reads it. */
const quoted = (word) => (/^[\w@%+=:,./-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`);

/** Returns the line of a quantity in the picture, of the norm that decides. */
function lineOf({ name, norm, norms }) {
  const { levels } = norms.find((other) => other.norm === norm) ?? norms[0];
  const points = levels.filter(({ error }) => error > 0).map(({ length, error }) => [length, error]);
  return { label: `${words(name)} ${norm}`, points };
}

/** Returns the command's text about a quantity: the part after the verdict if the verdict is shown above. */
function said({ says }, several) {
  return says.slice(several ? 0 : 1).map((sentence) => make("p", {}, sentence));
}

/** Returns the rows of a quantity: its name, norm, h, error and order. */
function rowsOf({ name, norms }) {
  return norms.flatMap(({ norm, levels }) => levels.map(({ length, error, order }) => [name, norm, length, error ?? "", order ?? ""]));
}

/** Makes the table of a quantity: errors and orders of each mesh in all norms. */
function errorsOf({ name, norms }) {
  const heads = ["h", ...norms.flatMap(({ norm }) => [norm, "order"])];
  const rows = norms[0].levels.map(({ length }, at) => [
    shown(length),
    ...norms.flatMap(({ levels }) => [shown(levels[at].error), levels[at].order == null ? "-" : levels[at].order.toFixed(2)]),
  ]);
  return table(heads, rows, `Errors of ${words(name)}`);
}

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

  function show({ document: judged, passes, notes, next: nextWords }) {
    const next = nextWords?.map(quoted).join(" ");
    const several = judged.quantities.length > 1;
    const good = judged.quantities.filter((quantity) => GOOD.includes(quantity.verdict)).length;
    const first = several ? `${judged.verdict}: ${good} of ${judged.quantities.length} quantities pass` : judged.quantities[0].says[0];
    const lines = judged.quantities.map(lineOf).filter((line) => line.points.length);
    const svg = lines.length ? plot(lines) : "";
    const picture = make("img", { alt: `Errors over mesh size. ${first}`, src: URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" })) });
    const tables = judged.quantities.map((quantity) => [make("h3", {}, words(quantity.name)), ...said(quantity, several), errorsOf(quantity)]);
    const csv = judged.quantities.flatMap(rowsOf).map((row) => row.join(",")).join("\n");
    const save = (label, name, content, type) => make("button", { type: "button", onclick: () => download(name, content, type) }, label);
    page.say(first);
    verdict.replaceChildren(
      make("p", { className: passes ? "verdict good" : "verdict wrong" }, first),
      ...(next
        ? [make("p", {}, "Next, with the command on your machine:"), make("pre", { className: "command" }, next), make("div", { className: "bar" }, make("button", { type: "button", onclick: () => copy(next) }, "Copy the command"))]
        : []),
      svg ? make("figure", {}, picture) : "",
      ...tables.flat(),
      make("h3", {}, "Notes"),
      make("ul", {}, [...new Set([...notes, ...(judged.notes ?? [])])].map((note) => make("li", {}, note))),
      make(
        "div",
        { className: "bar" },
        "Download ",
        save("JSON", "convergence.json", JSON.stringify(judged, null, 2), "application/json"),
        save("CSV", "convergence.csv", `quantity,norm,h,error,order\n${csv}\n`, "text/csv"),
        save("Picture", "convergence.svg", svg, "image/svg+xml"),
      ),
    );
  }
  // Judging waits for its button: a changed field starts no judgement.
  return null;
}
