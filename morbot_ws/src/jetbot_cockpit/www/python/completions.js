// What the editor suggests while a person types: names of the program, and what a node of the workshop's kind uses.

import { autocompletion, completeFromList, localCompletionSource } from "../vendor/codemirror/codemirror.js";

const WORDS = `and break continue def elif else except for from global if import in is not or pass return try while
  False None True abs float int len max min print range round str`.split(/\s+/);
const MEMBERS = {
  angular: ["z"], linear: ["x"], motion: ["angular", "linear"], publisher: ["publish", "get_num_connections"],
  rate: ["sleep"], math: ["atan2", "cos", "degrees", "hypot", "pi", "radians", "sin", "sqrt", "tau"],
  random: ["choice", "randint", "random", "uniform"],
  rospy: ["Publisher", "Rate", "ROSInterruptException", "Subscriber", "get_time", "init_node", "is_shutdown", "loginfo",
    "sleep", "spin", "wait_for_message"],
  time: ["monotonic", "sleep", "time"],
};

const options = (names) => names.map((label) => ({ label }));
const words = completeFromList(options([...WORDS, ...Object.keys(MEMBERS)]));

// Suggests what comes behind a dot.
function members(context) {
  const before = context.matchBefore(/\w+\.\w*/);
  const [owner] = before?.text.split(".") ?? [];
  if (!Object.hasOwn(MEMBERS, owner ?? "")) return null;
  return { from: before.from + owner.length + 1, options: options(MEMBERS[owner]), validFor: /^\w*$/ };
}

// Suggests nothing else behind a dot, in a text, or in a remark: there, the syntax tree has no names.
function names(context) {
  const local = localCompletionSource(context);
  const before = local && words(context);
  return local && { ...local, options: [...local.options, ...before?.options ?? []] };
}

// Enter begins a line, unless a person has gone to a suggestion.
export const COMPLETION = autocompletion({ override: [members, names], icons: false, selectOnOpen: false,
  interactionDelay: 0, maxRenderedOptions: 6 });
