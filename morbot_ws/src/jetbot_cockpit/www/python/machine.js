// MicroPython, made suspendable by binaryen's asyncify: what a program calls in the page may wait, at any depth, while
// the thread goes on. It knows no page and no robot.

import { loadMicroPython } from "../vendor/micropython/micropython.mjs";

const WASM = new URL("../vendor/micropython/micropython.wasm", import.meta.url).href;
const MEMORY = 64 * 1024 * 1024; // bytes; a program that needs more gets a MemoryError
const HEAP = 2 * 1024 * 1024; // bytes, to begin with
const STACK = 64 * 1024; // bytes of Python's own stack
const SUSPENDED = 512 * 1024; // bytes for what is on the stack of a program that waits
const COLLECT_EVERY = 500; // ms
const CALLS = ["call0", "call1", "call2", "calln"];
// How Python's code reaches into JavaScript, but for those calls
const ACCESSES = ["call0_kwarg", "calln_kwarg", "store_attr", "js_subscr_load", "js_subscr_store", "js_get_iter",
  "js_iter_next", "js_reflect_construct", "create_promise"];
const HEAD = 8; // bytes of asyncify's own there: where the stack ends, and may end
const REWINDING = 2; // a state of asyncify

// MicroPython collects garbage only where nothing of a program is on WebAssembly's stack, which it cannot read: so a
// program runs from a call that does not count as one of JavaScript's (__iter__), and while it waits all of that stack
// lies in `suspended`, an object of Python's.
const BEGINNING = `
import _javascript, sys
from uctypes import addressof

class _page:
    pass

for name in "NAMES".split():
    setattr(_page, name, getattr(_javascript, name))
sys.modules["_page"] = _page
suspended = bytearray(${SUSPENDED})
place = addressof(suspended)

class Program:
    def __iter__(self):
        run()
        return iter(())

program = Program()
from _run import run, variables
`;

export class Machine {
  /** @type {any} */
  wasm = null; // what MicroPython exports
  /** @type {any} */
  python = null;
  closed = false; // whether Python reaches no JavaScript but the page's functions
  /** @type {Promise<void> | null} */
  pending = null; // what a function of the page waits for
  collectedAt = 0;

  // wasm: MicroPython's bytes; files: the texts of Python's modules by their names; page: the functions of the module
  // _page, which return a promise to wait for, or what Python gets; written(text): a line on Python's output
  async load({ wasm, files, page, written }) {
    this.takeOver(wasm);
    const python = await loadMicroPython({ url: WASM, heapsize: HEAP, pystack: STACK, stdout: written,
      stderr: written });
    for (const [name, text] of Object.entries(files)) {
      python.FS.mkdirTree(`/lib/${name}`.replace(/\/[^/]*$/, ""));
      python.FS.writeFile(`/lib/${name}`, text);
    }
    const call = (value) => (value instanceof Promise ? this.wait(value) : value ?? null);
    const functions = Object.entries(page).map(([name, act]) => [name, (...given) => call(act(...given))]);
    python.registerJsModule("_javascript", Object.fromEntries(functions));
    python.runPython(BEGINNING.replace("NAMES", Object.keys(page).join(" ")));
    this.place = python.globals.get("place");
    this.python = python;
  }

  // Instantiates MicroPython from these bytes, with imports of which some are our own.
  takeOver(wasm) {
    const { instantiate } = WebAssembly;
    const own = async (_, { env, ...others }) => {
      const { instance } = await instantiate(wasm, { env: this.imports(env), ...others });
      this.wasm = instance.exports;
      return { instance };
    };
    Object.assign(globalThis, { fetch: () => null });
    Object.assign(WebAssembly, { instantiate: own, instantiateStreaming: own });
  }

  imports(env) {
    const own = { ...env };
    for (const name of CALLS) own[name] = this.suspending(env[name]);
    for (const name of ACCESSES) own[name] = (...given) => (this.closed ? refuse() : env[name](...given));
    for (const name of ["lookup_attr", "has_attr"]) own[name] = (...given) => !this.closed && env[name](...given);
    own.emscripten_resize_heap = (size) => size <= MEMORY && env.emscripten_resize_heap(size);
    return own;
  }

  // Returns the import that lets the program wait for what the page's function does.
  suspending(call) {
    let result;
    return (...given) => {
      if (this.wasm.asyncify_get_state() === REWINDING) {
        this.wasm.asyncify_stop_rewind();
        return result;
      }
      result = call(...given);
      if (this.pending) this.wasm.asyncify_start_unwind(this.place);
      return result;
    };
  }

  wait(promise) {
    this.pending = promise;
    return null; // Python's None, as undefined is not
  }

  // Runs Python's function `run`, which catches all that it raises.
  async run() {
    const program = this.python.globals.get("program");
    this.closed = true;
    this.words(this.place, 2).set([this.place + HEAD, this.place + SUSPENDED]);
    for (;;) {
      this.wasm.proxy_c_to_js_get_iter(program._ref);
      if (!this.pending) return;
      this.wasm.asyncify_stop_unwind();
      await this.pending;
      this.pending = null;
      if (performance.now() - this.collectedAt > COLLECT_EVERY) this.collect();
      this.wasm.asyncify_start_rewind(this.place);
    }
  }

  // Lets MicroPython collect garbage if it needs to.
  collect() {
    const [top, base] = [this.wasm.emscripten_stack_get_current(), this.wasm.emscripten_stack_get_base()];
    const [end, most] = this.words(this.place, 2);
    if (end + base - top > most) return;
    this.words(end, (base - top) / 4).set(this.words(top, (base - top) / 4));
    this.python.runPython("");
    this.collectedAt = performance.now();
  }

  // Returns what a function of Python's returns, also while the program waits; it must not wait itself.
  evaluate(name) {
    return this.python.globals.get(name)();
  }

  // Returns so many words of the memory from this address on.
  words(address, count) {
    return new Uint32Array(this.wasm.memory.buffer, address, count);
  }
}

function refuse() {
  throw new Error("A program reaches nothing of the page but its own functions.");
}
