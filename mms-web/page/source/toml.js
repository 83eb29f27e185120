// The colours of a TOML text, as a mode of CodeMirror's StreamLanguage.

const NUMBER = /^[+-]?(0x[\da-f_]+|\d[\d_]*(\.[\d_]+)?(e[+-]?\d+)?)(?![\w.])/i;

/** Reads on in a string up to its end, or to the end of the line. */
function readString(stream, state) {
  while (!stream.eol()) {
    if (stream.match(state.quote)) {
      state.quote = "";
      break;
    }
    if (stream.next() === "\\" && state.quote.startsWith('"')) stream.next();
  }
  if (state.quote.length === 1) state.quote = ""; // only a triple quote goes on in the next line
  return state.key ? "propertyName" : "string";
}

export const toml = {
  name: "toml",
  languageData: { commentTokens: { line: "#" } },
  startState: () => ({ open: "", key: true, quote: "" }),
  copyState: (state) => ({ ...state }),
  token(stream, state) {
    if (state.quote) return readString(stream, state);
    if (stream.sol() && !state.open) state.key = true;
    if (stream.eatSpace()) return null;
    if (stream.match(/^#.*/)) return "comment";
    if (state.key && !state.open && stream.match(/^\[\[?[^\]]*\]?\]?/)) return "atom";
    const quote = stream.match(/^("""|'''|"|')/);
    if (quote) {
      state.quote = quote[0];
      return readString(stream, state);
    }
    if (stream.match("=")) state.key = false;
    else if (stream.match(/^[[{]/)) {
      state.open += stream.current();
      state.key = stream.current() === "{";
      return "bracket";
    } else if (stream.match(/^[\]}]/)) {
      state.open = state.open.slice(0, -1);
      state.key = false;
      return "bracket";
    } else if (stream.match(",")) state.key = state.open.endsWith("{");
    else if (state.key && stream.match(/^[\w-]+/)) return "propertyName";
    else if (stream.match(/^(true|false)\b/)) return "atom";
    else if (stream.match(NUMBER)) return "number";
    else stream.next();
    return null;
  },
};
