// Puts the page together: the editor, the tabs, the requests that follow a change, dialogs and links.
import { showCheck, showMistakes } from "./check.js";
import { codePanel } from "./code.js";
import { derivationPanel } from "./derivation.js";
import { copy, download, errorBox, make } from "./dom.js";
import { createEditor, wording } from "./editor.js";
import { Cancelled, Engine, Refused } from "./engine.js";
import { judgePanel } from "./judge.js";
import { motionPanel } from "./motion.js";
import { fromFragment, toFragment } from "./share.js";
import { createTabs } from "./tabs.js";

const PAUSE = 300; // milliseconds without a key before the field is checked
const byId = (id) => document.getElementById(id);

let schema = null;
let gallery = { fields: [], materials: [] };
let name = "mine";
let edited = false;
let ready = false; // whether the gallery and the schema are here
let replacing = false;
let timer;

// One worker checks while the user types; the other serves the panels.
const checker = new Engine(() => showWork());
const worker = new Engine(() => showWork());

/**
 * The interface of the page for panels.
 * @typedef {typeof page} Page
 */
const page = {
  /** The field as requests name it. */
  source() {
    const withMaterial = !byId("material").hidden && materialEditor.text.trim();
    return { text: editor.text, name, ...(withMaterial ? { material: materialEditor.text } : {}) };
  },
  ask: (title, header, files) => worker.ask(title, header, files),
  say: (text) => (byId("status").textContent = text),
  refresh: () => refresh(true),
  /** Runs an action; `failed` shows its error. A cancelled one shows a note only. */
  async attempt(action, failed) {
    try {
      await action();
    } catch (error) {
      if (error instanceof Cancelled) return page.say("Cancelled");
      if (!(error instanceof Refused)) console.error(error);
      failed(error);
    }
  },
};

const editor = createEditor({ parent: byId("editor"), label: "Field file", schema: () => schema, onChange: changed });
const materialEditor = createEditor({ parent: byId("material-editor"), label: "Material file", onChange: changed });
const tabs = createTabs(byId("tabs"), byId("panels"), () => refresh());
const checkPanel = tabs.add("Check");
for (const [title, create] of [["Derivation", derivationPanel], ["Motion", motionPanel], ["Code", codePanel], ["Judge", judgePanel]]) {
  const tab = tabs.add(title);
  tab.problem = make("div", { className: "problem" });
  tab.panel.append(tab.problem);
  tab.update = create(tab.panel, page);
}

function showWork() {
  const work = [...checker.titles, ...worker.titles];
  byId("working").hidden = work.length === 0;
  byId("working-what").textContent = work.length ? `Working on ${[...new Set(work)].join(", ")} …` : "";
}

function changed() {
  const own = /^\s*model\s*=\s*["']\.{0,2}\/?[^"']*\.toml["']/m.test(editor.text);
  byId("material").hidden = !own;
  if (!replacing) edited = true;
  checkPanel.panel.classList.add("stale");
  clearTimeout(timer);
  timer = setTimeout(follow, replacing ? 0 : PAUSE);
}

/** Checks the field as it is now, and makes the open panel anew. */
function follow() {
  clearTimeout(timer);
  check();
  refresh();
}

async function check() {
  checker.cancel();
  const source = page.source();
  try {
    const result = await checker.ask("the check", { do: "check", ...source });
    showMessages(result.warnings);
    page.say(showCheck(checkPanel.panel, result));
    checkPanel.state(result.passes ? "good" : "wrong");
  } catch (error) {
    if (error instanceof Cancelled) return;
    showMessages(error.diagnostics ?? []);
    page.say(showMistakes(checkPanel.panel, error));
    checkPanel.state("wrong");
  }
  checkPanel.panel.classList.remove("stale");
}

/** Makes the open panel anew where the field, or a choice (`again`), has changed since it was made. */
async function refresh(again = false) {
  const tab = tabs.current;
  const source = JSON.stringify(page.source());
  if (!ready || !tab.update || (!again && tab.made === source)) return;
  worker.cancel();
  const turn = (tab.turn = {});
  const isLast = () => tab.turn === turn;
  tab.made = source;
  tab.problem.replaceChildren();
  tab.panel.classList.add("stale");
  try {
    await tab.update();
    if (isLast()) tab.panel.classList.remove("stale");
  } catch (error) {
    if (!isLast()) return;
    tab.made = null;
    if (error instanceof Cancelled) page.say("Cancelled");
    else tab.problem.replaceChildren(errorBox(error));
  }
}

function showMessages(diagnostics, heading = diagnostics.length ? `Messages: ${diagnostics.length}` : "No mistakes") {
  const mine = diagnostics.filter((diagnostic) => !isOfMaterial(diagnostic));
  editor.mark(mine);
  materialEditor.mark(diagnostics.filter(isOfMaterial));
  byId("messages-count").textContent = heading;
  byId("messages-list").replaceChildren(
    ...diagnostics.map((diagnostic) => {
      const where = diagnostic.line == null ? "" : `line ${diagnostic.line}, column ${diagnostic.column}: `;
      const visit = () => (isOfMaterial(diagnostic) ? materialEditor : editor).visit(diagnostic);
      const text = make("span", { className: "lines" }, `${diagnostic.severity === "warning" ? "warning" : "error"}: ${where}${wording(diagnostic)}`);
      return make("li", {}, diagnostic.line == null ? text : make("button", { type: "button", className: `message ${diagnostic.severity ?? "error"}`, onclick: visit }, text));
    }),
  );
}

const isOfMaterial = ({ path }) => Boolean(path) && !byId("material").hidden && !path.endsWith(`${name}.toml`) && path !== name;

/** Puts another field into the editor. */
function open(source) {
  replacing = true;
  name = source.name;
  editor.text = source.text;
  materialEditor.text = source.material ?? "";
  replacing = false;
  edited = false;
  showMessages([], "Messages");
  follow();
}

function openFromLink() {
  try {
    const source = fromFragment(location.hash);
    if (source) open(source);
    return Boolean(source);
  } catch (error) {
    page.say(error.message);
    byId("panels").prepend(errorBox(error));
    return false;
  }
}

byId("gallery").addEventListener("change", ({ target }) => {
  const field = gallery.fields.find((one) => one.name === target.value);
  if (field) open({ name: field.name, text: field.text, material: field.material_text });
});
byId("cancel").addEventListener("click", () => {
  checker.cancel();
  worker.cancel();
  page.say("Cancelled");
});
for (const button of document.querySelectorAll("[data-dialog]")) {
  button.addEventListener("click", () => {
    if (button.dataset.dialog === "share") byId("link").value = location.href.split("#")[0] + toFragment(page.source());
    byId(button.dataset.dialog).showModal();
  });
}
byId("template").addEventListener("close", ({ target }) => {
  if (target.returnValue !== "make") return;
  target.returnValue = "";
  const form = Object.fromEntries(new FormData(target.querySelector("form")));
  page.attempt(
    async () => {
      const { text } = await page.ask("the new field", { do: "template", ...form, dimension: Number(form.dimension) });
      byId("gallery").value = "";
      open({ name: "mine", text });
    },
    (error) => byId("panels").prepend(errorBox(error)),
  );
});
byId("share-file").hidden = location.protocol !== "file:";
byId("copy-link").addEventListener("click", async () => {
  page.say((await copy(byId("link").value, byId("link"))) ? "The link is copied" : "Copy the link by hand");
});
byId("save-field").addEventListener("click", () => download(`${name}.toml`, editor.text));
window.addEventListener("hashchange", openFromLink);
window.addEventListener("beforeunload", (event) => edited && event.preventDefault());

async function start() {
  const linked = openFromLink();
  try {
    [gallery, schema] = await Promise.all([
      worker.ask("the gallery", { do: "gallery" }),
      worker.ask("the schema", { do: "schema" }),
    ]);
  } catch (error) {
    return checkPanel.panel.replaceChildren(errorBox(error));
  }
  ready = true;
  const groups = [1, 2, 3].map((dimension) => {
    const fields = gallery.fields.filter((field) => field.dimension === dimension);
    return make("optgroup", { label: `${dimension}-D` }, fields.map(({ name: value, title }) => make("option", { value }, `${value}: ${title}`)));
  });
  byId("gallery").replaceChildren(make("option", { value: "" }, "choose one"), ...groups);
  const materials = byId("template").querySelector("[name=material]");
  materials.replaceChildren(...gallery.materials.map((material) => make("option", { value: material }, material)));
  materials.value = "neo_hookean";
  if (linked) return refresh();
  byId("gallery").value = "bar_1d";
  byId("gallery").dispatchEvent(new Event("change"));
}
start();
