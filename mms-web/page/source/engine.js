// The connection between the page and the module: unpacks it, keeps workers, sends requests, cancels them.

/** Reads the module out of the page, and compiles it. */
async function unpack() {
  const text = document.getElementById("module").textContent.trim();
  const letters = atob(text);
  const packed = new Uint8Array(letters.length);
  for (let at = 0; at < letters.length; at += 1) packed[at] = letters.charCodeAt(at);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return WebAssembly.compile(await new Response(stream).arrayBuffer());
}

const compiled = unpack();
const workerUrl = URL.createObjectURL(new Blob([WORKER_TEXT], { type: "text/javascript" }));

/** The error of a cancelled request. */
export class Cancelled extends Error {}

/** The error in a reply of the module; `diagnostics` have places. */
export class Refused extends Error {
  constructor({ message, diagnostics }) {
    super(message);
    this.diagnostics = diagnostics ?? [];
  }
}

/** A worker with a line of requests, answered one after another. */
export class Engine {
  #worker = null;
  #waiting = new Map();
  #next = 1;

  /** @param {() => void} onChange is called whenever requests come or go */
  constructor(onChange) {
    this.onChange = onChange;
  }

  #start(module) {
    const worker = new Worker(workerUrl);
    worker.onmessage = ({ data }) => this.#answered(data);
    worker.onerror = (event) => this.#stop(() => new Refused({ message: event.message || "the worker stopped" }));
    worker.postMessage({ module });
    return worker;
  }

  /** Sends a request; resolves to the reply of the module, rejects with `Refused` or `Cancelled`. */
  async ask(title, header, files = []) {
    const module = await compiled.catch((error) => {
      throw new Refused({ message: `this browser cannot run the module: ${error.message}` });
    });
    return new Promise((resolve, reject) => {
      const id = this.#next++;
      this.#waiting.set(id, { title, resolve, reject });
      this.#worker ??= this.#start(module);
      this.#worker.postMessage({ id, header, files });
      this.onChange();
    });
  }

  /** The titles of the running and waiting requests. */
  get titles() {
    return [...this.#waiting.values()].map((request) => request.title);
  }

  /** Ends the running and waiting requests. A later request starts a new worker. */
  cancel() {
    if (this.#waiting.size) this.#stop(() => new Cancelled("cancelled"));
  }

  #answered({ id, reply, broken }) {
    const request = this.#waiting.get(id);
    if (!request) return;
    this.#waiting.delete(id);
    if (reply.ok !== undefined) request.resolve(reply.ok);
    else request.reject(new Refused(reply.error));
    if (broken) this.#stop(() => new Cancelled("cancelled"));
    this.onChange();
  }

  #stop(reason) {
    this.#worker?.terminate();
    this.#worker = null;
    const waiting = [...this.#waiting.values()];
    this.#waiting.clear();
    for (const request of waiting) request.reject(reason());
    this.onChange();
  }
}
