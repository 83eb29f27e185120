// Finds where in a TOML text a position is: in a header, at a key, or at a value, and of which table.

/**
 * @typedef {object} Place
 * @property {"header"|"key"|"value"|"none"} kind  `none` is a comment, or behind a value
 * @property {string[]} path  the keys that lead there; "[]" is an entry of an array
 * @property {number} from  where the word begins that a completion replaces
 * @property {boolean} quoted  whether the position is inside a string
 */

/** @returns {Place} */
export function placeAt(text, position) {
  let table = []; // the path of the last header
  let open = []; // arrays and inline tables around the position: {bracket, path}
  let path = table; // the path of the key or value that is being read
  let kind = "key";
  let from = 0;
  let at = 0;
  const around = () => (open.length ? open[open.length - 1] : { bracket: "", path: table });

  while (at < position) {
    const letter = text[at];
    if (letter === "#") {
      const end = endOfLine(text, at);
      if (end >= position) return { kind: "none", path, from: position, quoted: false };
      at = end;
    } else if (letter === "[" && kind === "key" && !open.length && /(^|\n)[ \t]*$/.test(text.slice(from, at))) {
      const end = endOfLine(text, at);
      const [, brackets, name] = text.slice(at, Math.min(end, position)).match(/^(\[\[?)\s*([^\]\n]*)/);
      if (end >= position) {
        const closed = text.slice(at, position).includes("]");
        return { kind: closed ? "none" : "header", path: [brackets], from: position - name.length, quoted: false };
      }
      const keys = name.split(".").map(unquoted).filter(Boolean);
      table = brackets === "[[" ? [...keys, "[]"] : keys;
      path = table;
      at = from = end;
    } else if (letter === '"' || letter === "'") {
      const end = endOfString(text, at);
      if (end >= position && !(end === position && text[end - 1] === letter && end > at + 1)) {
        return { kind, path, from: at + 1, quoted: true };
      }
      at = end;
    } else if (letter === "=") {
      const key = text.slice(from, at).trim();
      path = [...around().path, ...key.split(".").map((part) => unquoted(part.trim()))];
      kind = "value";
      from = at += 1;
    } else if (letter === "[" || letter === "{") {
      path = letter === "[" ? [...path, "[]"] : path;
      open.push({ bracket: letter, path });
      kind = letter === "{" ? "key" : "value";
      from = at += 1;
    } else if (letter === "]" || letter === "}") {
      open.pop();
      const outer = around();
      path = outer.path;
      kind = "none";
      from = at += 1;
    } else if (letter === ",") {
      const inner = around();
      path = inner.path;
      kind = inner.bracket === "{" ? "key" : "value";
      from = at += 1;
    } else if (letter === "\n") {
      at += 1;
      if (!open.length) {
        path = table;
        kind = "key";
        from = at;
      }
    } else {
      at += 1;
    }
  }
  const word = text.slice(from, position).match(/[\w.+-]*$/)[0];
  const before = text.slice(from, position - word.length).trim();
  if (before) return { kind: "none", path, from: position, quoted: false };
  return { kind, path, from: position - word.length, quoted: false };
}

const unquoted = (key) => key.replace(/^["']|["']$/g, "");

function endOfLine(text, at) {
  const end = text.indexOf("\n", at);
  return end < 0 ? text.length : end;
}

/** Returns the index behind a string that begins at `at`; a string that is never closed ends with its line. */
function endOfString(text, at) {
  const quote = text[at];
  const triple = quote.repeat(3);
  if (text.startsWith(triple, at)) {
    const end = text.indexOf(triple, at + 3);
    return end < 0 ? text.length : end + 3;
  }
  for (let here = at + 1; here < text.length; here += 1) {
    if (text[here] === "\\" && quote === '"') here += 1;
    else if (text[here] === quote) return here + 1;
    else if (text[here] === "\n") return here;
  }
  return text.length;
}
