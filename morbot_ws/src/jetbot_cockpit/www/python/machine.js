// MicroPython, made suspendable by binaryen's asyncify: what a program calls in the page may wait, at any depth, while
// the thread goes on. It knows no page and no robot.

import { loadMicroPython } from "../vendor/micropython/micropython.mjs";

const WASM = new URL("../vendor/micropython/micropython.wasm", import.meta.url).href;
const MEMORY = 64 * 1024 * 1024; // bytes; a program that needs more gets a MemoryError
const HEAP = 2 * 1024 * 1024; // bytes, to begin with
const STACK = 64 * 1024; // bytes of Python's own stack
const SUSPENDED = 512 * 1024; // bytes for what is on the stack of a program that waits
const GARBAGE = 256 * 1024; // bytes to be used until garbage is looked for
const ROOM = 40 * 1024; // bytes of WebAssembly's stack for what is evaluated; MicroPython leaves 32 kB unused
const CALLS = ["call0", "call1", "call2", "calln"];
// What a program may use, whatever it does to MicroPython: its memory, the time, the page's functions
const HARMLESS = /^(?:invoke_|mp_js_|emscripten_|_emscripten_|_abort_js|proxy_js_free|js_check_existing|call[012n]$)/;
const ATTRIBUTES = ["lookup_attr", "has_attr"]; // of what is JavaScript's: there is none
const [EROFS, EBADF] = [69, 8]; // as WASI counts errors
const WRITES = 0o3 | 0o100 | 0o1000; // O_ACCMODE, O_CREAT, O_TRUNC
const HEAD = 8; // bytes of asyncify's own there: where the stack ends, and may end

// Of these modules nothing is left: they reach JavaScript, any address of the memory, files.
const EMPTIED = "js jsffi uctypes uos vfs";

// MicroPython collects garbage at the end of a call from JavaScript, as if nothing were on WebAssembly's stack, which
// it cannot read: so a program runs from a call that does not count as one (__iter__), and others come only while it
// waits, when all of that stack lies in `suspended`, an object of Python's.
const BEGINNING = `
import _javascript, gc, sys
from uctypes import addressof, bytearray_at

class _page:
    pass

for name in "NAMES".split():
    setattr(_page, name, getattr(_javascript, name))
sys.modules["_page"] = _page
gc.threshold(${GARBAGE})
suspended = bytearray(${SUSPENDED})
place = addressof(suspended)

class Program:
    def __init__(self, run):
        self.run = run

    def __iter__(self):
        self.run()
        return iter(())

from _run import run, variables
program = Program(run)
nothing = int

def number_at(address):
    return int.from_bytes(bytearray_at(address, 4), "little")

for name in "${EMPTIED}".split():
    names = number_at(id(__import__(name)) + 4)
    bytearray_at(names + 4, 8)[:] = bytes([number_at(names + 4) & 7]) + bytes(7)  # its count and size of a mp_map_t
del sys.modules["_javascript"]
`;

export class Machine {
  /** @type {any} */
  wasm = null; // what MicroPython exports
  /** @type {any} */
  python = null;
  closed = false; // whether Python reaches no JavaScript but the page's functions
  /** @type {(() => Promise<void>) | null} */
  pending = null; // what a function of the page waits for
  readable = true; // whether MicroPython can read what is on the stack
  resumes = false; // whether the program's calls are made again, after it has waited
  tops = []; // of the stack at the calls of `invoke` in a program that waits: addresses, the innermost first
  evaluates = false;
  place = 0; // the address of `suspended`
  /** @type {any} */
  program = null; // Python's objects
  /** @type {any} */
  nothing = null;

  // wasm: MicroPython's bytes; files: the texts of Python's modules by their names; page: the functions of the module
  // _page, which return what Python gets, or a function that is called once the program waits, and whose promise it
  // waits for; written(text): on Python's output
  async load({ wasm, files, page, written }) {
    this.takeOver(wasm);
    this.written = written;
    const python = await loadMicroPython({ url: WASM, heapsize: HEAP, pystack: STACK });
    for (const [name, text] of Object.entries(files)) {
      python.FS.mkdirTree(`/lib/${name}`.replace(/\/[^/]*$/, ""));
      python.FS.writeFile(`/lib/${name}`, text);
    }
    const call = (value) => (typeof value === "function" ? this.wait(value) : value ?? null);
    const functions = Object.entries(page).map(([name, act]) => [name, (...given) => call(act(...given))]);
    python.registerJsModule("_javascript", Object.fromEntries(functions));
    python.runPython(BEGINNING.replace("NAMES", Object.keys(page).join(" ")));
    for (const name of ["place", "suspended", "program", "variables", "nothing"]) this[name] = python.globals.get(name);
    python.runPython("globals().clear()");
  }

  // Instantiates MicroPython from these bytes, with imports of which some are our own.
  takeOver(wasm) {
    const { instantiate } = WebAssembly;
    const own = async (_, { env, wasi_snapshot_preview1: wasi }) => {
      const imports = { env: this.imports(env), wasi_snapshot_preview1: { ...wasi, fd_write: this.writes(wasi) } };
      const { instance } = await instantiate(wasm, imports);
      this.wasm = instance.exports;
      return { instance };
    };
    Object.assign(globalThis, { fetch: () => null });
    Object.assign(WebAssembly, { instantiate: own, instantiateStreaming: own });
  }

  imports(env) {
    const own = { ...env };
    for (const name of Object.keys(env).filter((each) => !HARMLESS.test(each))) {
      own[name] = (...given) => (this.closed ? refuse(name) : env[name](...given));
    }
    for (const name of CALLS) own[name] = this.suspending(env[name]);
    const invokes = Object.keys(env).filter((name) => name.startsWith("invoke_"));
    for (const name of invokes) own[name] = this.invoking(env[name]);
    for (const name of ["__syscall_stat64", "__syscall_getcwd"]) own[name] = env[name];
    own.__syscall_openat = (...given) => (this.closed && given[2] & WRITES ? -EROFS : env.__syscall_openat(...given));
    own.emscripten_resize_heap = (size) => size >>> 0 <= MEMORY && env.emscripten_resize_heap(size);
    return own;
  }

  // Returns the import by which Python writes: to its output alone.
  writes(wasi) {
    const decoder = new TextDecoder();
    return (file, buffers, count, written) => {
      if (!this.closed) return wasi.fd_write(file, buffers, count, written);
      if (file !== 1 && file !== 2) return EBADF;
      const parts = Array.from({ length: count }, (_, index) => this.words(buffers + 8 * index, 2));
      for (const [at, length] of parts) {
        this.written(decoder.decode(new Uint8Array(this.wasm.memory.buffer, at, length), { stream: true }));
      }
      this.words(written, 1)[0] = parts.reduce((sum, [, length]) => sum + length, 0);
      return 0;
    };
  }

  // Returns the import that lets the program wait for what the page's function does.
  suspending(call) {
    let kept; // what it has returned to the program that waits
    return (...given) => {
      if (this.resumes) {
        this.resumes = false;
        this.wasm.asyncify_stop_rewind();
        return kept;
      }
      const result = call(...given);
      if (this.pending) {
        kept = result;
        this.wasm.asyncify_start_unwind(this.place);
      }
      return result;
    };
  }

  // Returns the import that calls what an exception may end: then the stack is as before the call, also if the program
  // has waited in it.
  invoking(invoke) {
    return (...given) => {
      const top = this.resumes ? this.tops.pop() : this.wasm.emscripten_stack_get_current();
      const result = invoke(...given);
      if (this.pending) this.tops.push(top); // the program is about to wait
      else this.wasm._emscripten_stack_restore(top);
      return result;
    };
  }

  wait(act) {
    if (this.evaluates) throw new Error("What is evaluated must not wait.");
    this.pending = act;
    return null; // Python's None, as undefined is not
  }

  // Runs Python's function `run`, which catches all that it raises.
  async run() {
    this.closed = true;
    this.words(this.place, 2).set([this.place + HEAD, this.place + SUSPENDED]);
    for (;;) {
      this.wasm.proxy_c_to_js_get_iter(this.program._ref);
      const { pending } = this;
      if (!pending) return;
      this.wasm.asyncify_stop_unwind();
      this.pending = null;
      this.readable = this.keep();
      await pending();
      if (this.readable) this.nothing(); // any call: this one needs none of Python's stack, of which little may be left
      this.readable = this.resumes = true;
      this.wasm.asyncify_start_rewind(this.place);
    }
  }

  // Copies what is on WebAssembly's stack into `suspended`. Returns false if there is no room for it.
  keep() {
    const [top, base] = [this.wasm.emscripten_stack_get_current(), this.wasm.emscripten_stack_get_base()];
    const [end, most] = this.words(this.place, 2);
    if (end + base - top > most) return false;
    this.words(end, (base - top) / 4).set(this.words(top, (base - top) / 4));
    return true;
  }

  // Returns what a function of Python's returns, also while the program waits; it must not wait itself. Returns null
  // if the program is so deep that there is no room.
  evaluate(name) {
    const room = this.wasm.emscripten_stack_get_current() - this.wasm.emscripten_stack_get_end();
    if (!this.readable || room < ROOM) return null;
    this.evaluates = true;
    try {
      return this[name]();
    } finally {
      this.evaluates = false;
    }
  }

  // Returns so many words of the memory from this address on.
  words(address, count) {
    return new Uint32Array(this.wasm.memory.buffer, address, count);
  }
}

function refuse(name) {
  if (ATTRIBUTES.includes(name)) return 0;
  if (name.startsWith("__syscall_")) return -EROFS;
  throw new Error(`A program reaches nothing of the page but its own functions: ${name}`);
}
