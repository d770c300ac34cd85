// How MicroPython says that a program fails.

import { mark } from "#www/python/marks.js";
import { pythonLanguage } from "#www/vendor/codemirror/codemirror.js";
import { loadMicroPython } from "#www/vendor/micropython/micropython.mjs";

import { runPython } from "./micropython.js";

const RUN = `
import io, json, sys

def each(line, values):
    for value in values:
        yield value

def fail(text):
    try:
        exec(compile(text, "program.py", "exec"), {"__name__": "__main__", "_at": lambda *_, **__: None, "_each": each})
    except BaseException as problem:
        trace = io.StringIO()
        sys.print_exception(problem, trace)
        return json.dumps([type(problem).__name__, str(problem), trace.getvalue()])
`;

const python = await loadMicroPython({ pystack: 64 * 1024, stdout: () => {} });
python.runPython(RUN);
const fail = python.globals.get("fail");

// Returns how a program fails, as explain() takes it; without the page's modules.
export function failureOf(program) {
  const answer = fail(mark(program, pythonLanguage.parser.parse(program)));
  return answer ? toFailure(...JSON.parse(answer)) : { type: "", message: "it does not fail", line: 0 };
}

// Returns how a program fails that uses the page's modules.
export async function failureInPage(program) {
  let failure = { type: "", message: "it does not fail", line: 0 };
  await runPython(program, { more: { fail: (...said) => { failure = toFailure(...said); } } });
  return failure;
}

function toFailure(type, message, trace) {
  return { type, message, line: Number([...trace.matchAll(/"program\.py", line (\d+)/g)].at(-1)?.[1] ?? 0) };
}
