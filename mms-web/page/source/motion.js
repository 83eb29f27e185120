// The panel "Motion": the body as it moves, and a table of values at a point of it.
import { Drawing, GRADIENT } from "./draw.js";
import { errorBox, make, shown, table } from "./dom.js";

const FRAMES = 49;
const PER_SECOND = 12;
const CELLS = { 1: 64, 2: 20, 3: 8 };

/** @param {import("./main.js").Page} page */
export function motionPanel(panel, page) {
  const color = make("select", { onchange: () => page.refresh() }, make("option", { value: "jacobian" }, "jacobian"));
  const canvas = make("canvas", { className: "motion", role: "img", onclick: (event) => pick(event) });
  const play = make("button", { type: "button", onclick: () => turn(!timer) }, "Play");
  const slider = make("input", { type: "range", min: 0, max: 0, value: 0, step: 1, oninput: () => (turn(false), draw()) });
  const time = make("output", {});
  const [low, unit, high] = [make("span", {}), make("span", {}), make("span", {})];
  const ramp = make("div", { className: "ramp" });
  ramp.style.background = GRADIENT;
  const controls = make("div", { className: "bar" }, play, make("label", { className: "grow" }, "Time ", slider), time);
  const coordinates = make("span", { className: "bar" });
  const at = make("input", { type: "text", size: 10, inputMode: "decimal", spellcheck: false });
  const values = make("div", {});
  panel.append(
    make("div", { className: "bar" }, make("label", {}, "Colour ", color), make("span", { className: "quiet" }, "of a vector or tensor its norm")),
    canvas,
    make("div", { className: "legend" }, ramp, make("div", { className: "ends" }, low, unit, high)),
    controls,
    make("h3", {}, "Values at a point"),
    make("p", { className: "quiet" }, "Click the body, or type the reference position X and the time t."),
    make(
      "form",
      { className: "bar", onsubmit: (event) => (event.preventDefault(), evaluate()) },
      coordinates,
      make("label", {}, "t ", at),
      make("button", { type: "submit" }, "Evaluate"),
    ),
    values,
  );

  let drawing = null;
  let motion = null;
  let mark = null;
  let timer = null;
  let started = false;
  new ResizeObserver(() => draw()).observe(canvas);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => draw());

  function draw() {
    if (!drawing || !canvas.clientWidth) return;
    const frame = Number(slider.value);
    drawing.draw(frame, mark);
    time.textContent = `t = ${shown(motion.times[frame])}`;
    slider.ariaValueText = time.textContent;
  }

  function turn(on) {
    clearInterval(timer);
    timer = null;
    play.textContent = on ? "Pause" : "Play";
    if (!on) return;
    timer = setInterval(() => {
      if (!panel.isConnected || panel.hidden) return;
      slider.value = (Number(slider.value) + 1) % motion.points.length;
      draw();
    }, 1000 / PER_SECOND);
  }

  function pick(event) {
    const box = canvas.getBoundingClientRect();
    const found = drawing?.pointAt(event.clientX - box.left, event.clientY - box.top);
    if (!found) return;
    mark = found.mark;
    [...coordinates.querySelectorAll("input")].forEach((input, index) => (input.value = shown(found.point[index])));
    at.value = String(motion.times[Number(slider.value)]);
    turn(false);
    draw();
    evaluate();
  }

  async function evaluate() {
    await page.attempt(async () => {
      const number = (input, name) => {
        const value = Number(input.value);
        if (!input.value.trim() || !Number.isFinite(value)) throw new Error(`${name}: \`${input.value}\` is no number`);
        return value;
      };
      const inputs = [...coordinates.querySelectorAll("input")];
      const place = inputs.map((input) => number(input, input.name));
      const header = { do: "values", ...page.source(), at: place, time: number(at, "t"), set: {} };
      const answer = await page.ask("the values", header);
      const rows = answer.values.map(({ quantity, symbol, unit: measure, components, shape }) => {
        const columns = shape?.[1] || 1;
        const lines = [];
        for (let from = 0; from < components.length; from += columns) {
          lines.push(make("tr", {}, components.slice(from, from + columns).map((value) => make("td", {}, value == null ? "undefined" : String(value)))));
        }
        return [quantity.replaceAll("_", " "), symbol ?? "", make("table", { className: "matrix" }, make("tbody", {}, lines)), measure ?? ""];
      });
      values.replaceChildren(table(["quantity", "symbol", "value", "unit"], rows, `Values at X = ${place.join(", ")}, t = ${at.value}`));
    }, (error) => values.replaceChildren(errorBox(error)));
  }

  /** Gives the form one input for each coordinate, at the middle of the body. */
  function showCoordinates(names) {
    const middle = names.map((_, axis) => {
      const all = motion.reference.map((point) => point[axis]);
      return (Math.min(...all) + Math.max(...all)) / 2;
    });
    const same = [...coordinates.querySelectorAll("input")].map((input) => input.name).join() === names.join();
    if (same) return;
    coordinates.replaceChildren(
      ...names.map((name, axis) =>
        make("label", {}, `${name} `, make("input", { type: "text", name, size: 8, inputMode: "decimal", spellcheck: false, value: shown(middle[axis]) })),
      ),
    );
    at.value = String(motion.times[0]);
  }

  return async () => {
    const source = page.source();
    const dimension = Number(source.text.match(/^\s*dimension\s*=\s*(\d)/m)?.[1] ?? 2);
    const header = { do: "motion", ...source, color: color.value, frames: FRAMES, cells: CELLS[dimension] ?? 16 };
    motion = await page.ask("the motion", header);
    const chosen = color.value;
    color.replaceChildren(...motion.colors.map((name) => make("option", { value: name }, name.replaceAll("_", " "))));
    color.value = chosen;
    const radial = /^\s*coordinates\s*=\s*"axisymmetric"/m.test(source.text);
    const names = (radial ? ["R", "Z"] : ["X", "Y", "Z"]).slice(0, motion.dimension);
    mark = null;
    values.replaceChildren();
    drawing = new Drawing(canvas, motion, radial ? ["r", "z"] : ["x", "y", "z"]);
    slider.max = motion.points.length - 1;
    controls.hidden = motion.points.length < 2;
    [low.textContent, high.textContent] = motion.range.map(shown);
    unit.textContent = `${chosen.replaceAll("_", " ")}${motion.unit && motion.unit !== "1" ? ` in ${motion.unit}` : ""}`;
    canvas.ariaLabel = `The body as it moves, coloured by ${unit.textContent}, from ${low.textContent} to ${high.textContent}`;
    showCoordinates(names);
    draw();
    const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
    turn(started ? Boolean(timer) : !calm && motion.points.length > 1);
    started = true;
  };
}
