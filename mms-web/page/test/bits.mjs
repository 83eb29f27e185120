// Asks the module for all quantities of three fields, and compares them with the command's values, bit for bit:
//
//     node bits.mjs MODULE.wasm MMS
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";

/** Fields, points and times. */
const POINTS = [
  ["bar_1d", [0.37], 0.011],
  ["plane_strain_gent", [0.31, 0.22], 0.01],
  ["twisted_column", [0.1, 0.2, 0.3], 0.02],
];

const [modulePath, command] = process.argv.slice(2);
const { instance } = await WebAssembly.instantiate(readFileSync(modulePath), {});
const { memory, room, answer, answer_length: answerLength } = instance.exports;

/** Asks the module, as the page's worker does. */
function ask(header) {
  const text = new TextEncoder().encode(JSON.stringify(header));
  const at = room(4 + text.length);
  new DataView(memory.buffer).setUint32(at, text.length, true);
  new Uint8Array(memory.buffer, at + 4, text.length).set(text);
  const start = answer();
  const bytes = new Uint8Array(memory.buffer, start, answerLength());
  const reply = JSON.parse(new TextDecoder().decode(bytes));
  if (reply.error) throw new Error(reply.error.message);
  return reply.ok;
}

/** The values of the command at the same point. */
function evaluated(name, at, time) {
  const words = ["eval", name, `--at=${at.join(",")}`, `--time=${time}`, "--json"];
  const printed = execFileSync(command, words, { stdio: ["ignore", "pipe", "ignore"] });
  return JSON.parse(printed).points[0];
}

const { fields } = ask({ do: "gallery" });
let compared = 0;
for (const [name, at, time] of POINTS) {
  const { text, material_text: material } = fields.find((field) => field.name === name);
  const right = evaluated(name, at, time);
  for (const { quantity, components } of ask({ do: "values", name, text, material, at, time }).values) {
    right[quantity].forEach((expected, place) => {
      compared += 1;
      if (!Object.is(expected, components[place])) {
        throw new Error(`${name}: ${quantity} ${place} is ${components[place]}, and ${expected} by the command`);
      }
    });
  }
}
if (compared < 100) throw new Error(`only ${compared} numbers were compared`);
console.log(`${compared} numbers of ${POINTS.length} fields have the bits of the command`);
