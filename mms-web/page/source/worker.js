// Runs the module in a worker. A message is {id, header, files}; the answer is {id, reply}.

/** The exports of the module, once it is loaded. */
let exports;
let loading;
const encoder = new TextEncoder();
const decoder = new TextDecoder();

/** Writes a request into the module's buffer: the length of the header, the header, the files. */
function ask(header, files) {
  const text = encoder.encode(JSON.stringify(header));
  const length = 4 + text.length + files.reduce((sum, file) => sum + file.byteLength, 0);
  const start = exports.room(length);
  const room = new Uint8Array(exports.memory.buffer, start, length);
  new DataView(exports.memory.buffer).setUint32(start, text.length, true);
  room.set(text, 4);
  let at = 4 + text.length;
  for (const file of files) {
    room.set(new Uint8Array(file), at);
    at += file.byteLength;
  }
  const reply = exports.answer(length);
  return JSON.parse(decoder.decode(new Uint8Array(exports.memory.buffer, reply, exports.answer_length())));
}

self.onmessage = async ({ data }) => {
  if (data.module) {
    loading = WebAssembly.instantiate(data.module, {}).then((instance) => (exports = instance.exports));
    return;
  }
  try {
    await loading;
    self.postMessage({ id: data.id, reply: ask(data.header, data.files) });
  } catch (error) {
    // A trap leaves the memory in an unknown state: the page starts a new worker.
    const message = `the computation stopped (${error.message}): it may need more memory than a page has. Use the command mms for it.`;
    self.postMessage({ id: data.id, broken: true, reply: { error: { message, diagnostics: [] } } });
  }
};
