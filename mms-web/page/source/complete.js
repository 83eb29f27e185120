// Completions of a field file, from its JSON Schema.
import { placeAt } from "./place.js";

/** Returns the schema of the value at a path; of an entry of an array after "[]". */
function schemaAt(schema, path) {
  let node = schema;
  for (const key of path) {
    if (!node) return null;
    if (key === "[]") node = node.items;
    else node = node.properties?.[key] ?? (typeof node.additionalProperties === "object" ? node.additionalProperties : null);
  }
  return node ?? null;
}

/** Returns all words that a value may have. */
function words(node) {
  return [...(node.enum ?? []), ...(node.anyOf ?? []).flatMap(words)];
}

/** Returns the properties that the schema adds for the shipped material that the text names. */
function materialKeys(schema, text) {
  const model = text.match(/^\s*model\s*=\s*["']([^"']*)["']/m)?.[1];
  const rule = (schema.allOf ?? []).find((entry) => entry.if?.properties?.material?.properties?.model?.const === model);
  return model ? (rule?.then?.properties?.material?.propertyNames?.enum ?? []) : [];
}

/** Returns the names that a formula may use: coordinates, functions, and the names the text declares. */
function namesOfFormulas(schema, text) {
  const reserved = schema.properties?.parameters?.propertyNames?.not?.enum ?? [];
  const declared = [];
  let table = "";
  for (const line of text.split("\n")) {
    table = line.match(/^\s*\[\[?\s*([\w.]+)/)?.[1] ?? table;
    const name = line.match(/^\s*(\w+)\s*=/)?.[1];
    const doc = line.match(/\bdoc\s*=\s*"([^"]*)"/)?.[1];
    if (name && ["parameters", "let", "given"].includes(table)) declared.push({ label: name, type: "variable", detail: table, info: doc });
  }
  return [...declared, ...reserved.map((label) => ({ label, type: label.length > 2 ? "function" : "constant" }))];
}

const isFormula = (node) => Array.isArray(node?.type) && node.type.includes("string") && node.type.includes("number");

function option(label, node, apply, type) {
  return { label, type, info: node?.description, ...(apply === undefined ? {} : { apply }) };
}

/** Returns the completions at a position, in the form of CodeMirror. */
export function completions(schema, text, position, explicit) {
  const place = placeAt(text, position);
  if (place.kind === "none") return null;
  const typed = text.slice(place.from, position);
  if (place.kind === "header") {
    const isArray = place.path[0] === "[[";
    const options = Object.entries(schema.properties)
      .filter(([, node]) => (node.type === "array") === isArray)
      .map(([key, node]) => option(key, node, key + (isArray ? "]]" : "]"), "class"));
    return { from: place.from, options, validFor: /^\w*$/ };
  }
  const node = schemaAt(schema, place.path);
  if (!node) return null;
  if (place.kind === "key") {
    if (!typed && !explicit) return null;
    const named = Object.entries(node.properties ?? {}).map(([key, value]) => option(key, value, `${key} = `, "property"));
    const more = place.path.join() === "material" ? materialKeys(schema, text) : [];
    const added = more.filter((key) => !node.properties[key]).map((key) => option(key, node.additionalProperties, `${key} = `, "property"));
    const tables = place.path.length ? [] : Object.keys(schema.properties).map((key) => option(key, schema.properties[key], `[${key}]`, "class"));
    return { from: place.from, options: place.path.length ? [...named, ...new Set(added)] : tables, validFor: /^\w*$/ };
  }
  const choices = [...new Set(words(node))];
  if (choices.length) {
    const quote = (word) => (place.quoted || typeof word !== "string" ? `${word}` : `"${word}"`);
    const options = choices.map((word) => ({ label: `${word}`, type: "enum", info: node.description, apply: quote(word) }));
    return { from: place.from, options, validFor: /^\w*$/ };
  }
  if (place.quoted && isFormula(node)) {
    const word = typed.match(/[A-Za-z_]\w*$/)?.[0] ?? "";
    if (!word && !explicit) return null;
    return { from: position - word.length, options: namesOfFormulas(schema, text), validFor: /^\w*$/ };
  }
  return null;
}
