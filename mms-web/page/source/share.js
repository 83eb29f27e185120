// Links that hold a field in their fragment: compressed, in letters that need no escapes.
import { deflateSync, inflateSync, strFromU8, strToU8 } from "fflate";

/** Returns the fragment of a source. */
export function toFragment(source) {
  const packed = deflateSync(strToU8(JSON.stringify(source)), { level: 9 });
  const letters = btoa(Array.from(packed, (byte) => String.fromCharCode(byte)).join(""));
  return `#field=${letters.replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "")}`;
}

/** Returns the source in a fragment; null if there is none. Throws if it is damaged. */
export function fromFragment(fragment) {
  const letters = fragment.match(/^#field=(.+)$/)?.[1];
  if (!letters) return null;
  try {
    const packed = Uint8Array.from(atob(letters.replaceAll("-", "+").replaceAll("_", "/")), (letter) => letter.charCodeAt(0));
    const { text, name, material } = JSON.parse(strFromU8(inflateSync(packed)));
    if (typeof text !== "string") throw new Error("no text");
    return { text, name: typeof name === "string" ? name : "mine", ...(typeof material === "string" ? { material } : {}) };
  } catch {
    throw new Error("the link is damaged: its field cannot be read. Ask for it once more.");
  }
}
