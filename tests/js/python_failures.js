// What MicroPython says of programs that fail.

import { fileURLToPath } from "node:url";

import { loadMicroPython } from "#www/vendor/micropython/micropython.mjs";

const WASM = new URL("../../morbot_ws/src/jetbot_cockpit/www/vendor/micropython/micropython.wasm", import.meta.url);
const RUN = `
import io, json, sys

def fail(text):
    try:
        exec(compile(text, "program.py", "exec"), {"__name__": "__main__"})
    except BaseException as problem:
        trace = io.StringIO()
        sys.print_exception(problem, trace)
        return json.dumps([type(problem).__name__, str(problem), trace.getvalue()])
`;

const python = await loadMicroPython({ url: fileURLToPath(WASM), pystack: 64 * 1024, stdout: () => {} });
python.runPython(RUN);
const fail = python.globals.get("fail");

// Returns how a program fails, as explain() takes it, or null if it does not.
export function failureOf(program) {
  const answer = fail(program);
  if (!answer) return null;
  const [type, message, trace] = JSON.parse(answer);
  return { type, message, line: Number([...trace.matchAll(/"program\.py", line (\d+)/g)].at(-1)?.[1] ?? 0) };
}
