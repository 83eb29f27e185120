// Completions at places of a field file: node --test mms-web/page/test/complete.test.js
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { completions } from "../source/complete.js";
import { placeAt } from "../source/place.js";

const schema = JSON.parse(readFileSync(new URL("../../../docs/field.schema.json", import.meta.url), "utf8"));

/** Returns the labels offered where the text has a bar. */
function labels(text) {
  const at = text.indexOf("|");
  const whole = text.slice(0, at) + text.slice(at + 1);
  return (completions(schema, whole, at, true)?.options ?? []).map(({ label }) => label);
}

const offers = (text, ...wanted) => assert.deepEqual(wanted.filter((word) => !labels(text).includes(word)), [], text);

test("headers, keys and values are offered at their place", () => {
  offers("[|", "field", "parameters", "domain");
  offers("[[|", "check", "study", "balance");
  offers("[field]\ntitle = \"a\"\n|", "dimension", "coordinates");
  offers("[domain]\nshape = |", "box", "annulus");
  offers("[domain]\nshape = \"b|", "box", "sphere");
  offers("[boundary]\nx_min = \"free\" # a = [\nx_max = '|'", "fixed", "traction");
  offers("[parameters]\nlength = { value = 1, |", "unit", "doc", "range");
  offers("[[study]]\ncells = [\n  8, # 9\n  16,\n]\nshape = \"|", "cpgimp", "linear");
  offers("[material]\nmodel = \"gent\"\n|", "density", "Jm", "kappa");
  offers("[rigid]\nrotation = { |", "axis", "angle");
});

test("formulas are offered the names that the text declares", () => {
  const text = "[parameters]\nlength = { value = 1 }\n[let]\nc = \"sqrt(len|)\"\n";
  offers(text, "length", "c", "sqrt", "X", "t");
  assert.deepEqual(labels("[field]\ntitle = \"le|\""), []);
});

test("nothing is offered in comments, behind values and behind headers", () => {
  for (const text of ["# [|", "[field] |", "[field]\ndimension = 1 |", "[field]\ntitle = \"a\" |", "[domain]\nlower = [0] |"]) {
    assert.deepEqual(labels(text), [], text);
  }
});

test("every place of a field file is found", () => {
  const text = readFileSync(new URL("../../../fields/bar_1d.toml", import.meta.url), "utf8");
  for (let at = 0; at <= text.length; at += 1) {
    const place = placeAt(text, at);
    assert.ok(place.from <= at && ["header", "key", "value", "none"].includes(place.kind), `at ${at}`);
  }
  assert.deepEqual(placeAt(text, text.indexOf("annulus: inner")).kind, "none");
});
