// The names that a Python program knows.

import { KEYWORDS, readStatements, VALUES } from "./tokens.js";

/** @import { Token } from "./tokens.js" */

export const BUILTINS = [...KEYWORDS, ...VALUES, ...("abs all any bin bool chr dict dir divmod enumerate filter float "
  + "format frozenset getattr hasattr hex id input int isinstance issubclass iter len list map max min next object "
  + "open ord pow print property range repr reversed round set setattr sorted str sum super tuple type zip Exception "
  + "IndexError KeyError TypeError ValueError ZeroDivisionError").split(" ")];

export const MODULES = ("rospy geometry_msgs std_msgs nav_msgs sensor_msgs math random time sys json collections copy "
  + "datetime functools itertools operator re string struct").split(" ");
const MESSAGES = new Map(Object.entries({
  "geometry_msgs.msg": "Twist Vector3 Point Quaternion Pose Pose2D", "nav_msgs.msg": "Odometry",
  "std_msgs.msg": "Bool String Int32 Float32 Float64 Float32MultiArray Header Empty",
}).map(([module, names]) => [module, names.split(" ")]));

// What modules and values have
const MEMBERS = new Map(Object.entries({
  math: "sin cos tan asin acos atan atan2 sqrt pi tau e hypot floor ceil radians degrees fabs exp log pow inf",
  random: "randint random choice shuffle uniform seed gauss sample", time: "time sleep monotonic perf_counter",
  rospy: "init_node is_shutdown Publisher Subscriber Rate sleep get_time loginfo logwarn logerr get_param spin "
    + "Duration wait_for_message on_shutdown Time ROSInterruptException",
  str: "upper lower split strip join format replace find startswith endswith count index isdigit",
  list: "append insert pop remove sort index count extend reverse clear copy",
  dict: "keys values items get pop update clear copy", set: "add remove discard union clear",
}).map(([name, members]) => [name, members.split(" ")]));
const OTHERS = ("linear angular x y z w data pose position orientation twist theta header stamp child_frame_id publish "
  + "sleep remaining unregister to_sec now from_sec get_num_connections").split(" "); // of messages and rospy's objects

const IMPORTED = [...MEMBERS].filter(([module]) => MODULES.includes(module));

// Returns what a module or a value of this type has, as far as it is known here.
/** @param {string} owner */
export const membersOf = (owner) => MEMBERS.get(owner) ?? MESSAGES.get(owner) ?? OTHERS;

// Returns the line that imports this name, or undefined.
/** @param {string} name */
export function importOf(name) {
  if (MODULES.includes(name)) return `import ${name}`;
  const [module] = [...MESSAGES, ...IMPORTED].find(([, names]) => names.includes(name)) ?? [];
  return module && `from ${module} import ${name}`;
}

// Returns the names to which a program gives a value, and whether it does so outside of functions.
/** @param {string} source @returns {Map<string, boolean>} */
export function boundNames(source) {
  const bound = new Map();
  for (const { tokens, indent } of readStatements(source).statements) {
    for (const name of namesBoundBy(tokens)) bound.set(name, bound.get(name) || !indent);
    if (tokens[0].text === "def") for (const name of parameters(tokens)) bound.set(name, bound.get(name) ?? false);
  }
  return bound;
}

// Yields the names to which this statement gives a value.
/** @param {Token[]} tokens */
export function *namesBoundBy(tokens) {
  const last = tokens.findLastIndex(({ text, opener }) => /^([^=!<>]|\/\/|<<|>>|\*\*)?=$/.test(text) && !opener);
  let head = ""; // of a list: the last one that is neither a name nor a comma
  for (const [index, { kind, text, opener }] of tokens.entries()) {
    const [before, after] = [tokens[index - 1]?.text, tokens[index + 1]?.text];
    const target = index < last && before !== "." && !opener?.call && ![".", "(", "["].includes(after);
    const named = ["def", "class", "as", "import", "for", "global"].includes(before);
    const listed = before === "," && ["import", "for", "global"].includes(head); // "for a, b in"
    if (kind === "name" && (target || named || listed)) yield text;
    if (kind !== "name" && text !== ",") head = text;
  }
}

function parameters(tokens) {
  const end = tokens.findIndex(({ kind, opener }) => kind === "close" && !opener);
  return tokens.slice(2, end).filter(({ kind }) => kind === "name").map(({ text }) => text);
}

// Returns the names of the attributes and functions that a program itself makes.
/** @param {string} source */
export const methodsOf = (source) => [...source.matchAll(/\b(?:self\.|def )(\w+)/g)].map(([, name]) => name);
