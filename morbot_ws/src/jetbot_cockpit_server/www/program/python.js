// Writes the program as a node of the workshop's kind. Blockly's own generator writes what is not the robot's.

const { Blockly } = globalThis;
const python = Blockly.Python;
const Order = globalThis.python.Order;

const MARK = /^\s*#@(\d+)\n/; // a line of its own before a block's first line: which of the marked blocks it is
const ENDS = /[^\n\x20-\x7e\u00a0-\u{10ffff}]/gu; // other ends of lines, and control characters
const TICK = ["publisher.publish(motion)", "rate.sleep()"];
const LOOPS = ["robot_loop", "controls_repeat_ext", "controls_whileUntil", "controls_for"];
const STOP = "motion.linear.x = motion.angular.z = 0";
const HEAD = ["rospy.init_node(%)", 'publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1)',
  "rate = rospy.Rate(10)", "motion = Twist()"];

// What a program needs beside its own lines. imports; code; start: what main() does first; after: of which others
const HELPERS = {
  wait: {
    code: `def wait(seconds):
    """Repeat the command ten times per second."""
    end = rospy.get_time() + seconds
    while rospy.get_time() < end:
        publisher.publish(motion)
        rospy.sleep(min(0.1, end - rospy.get_time()))`,
  },
  drive: {
    needs: ["wait"],
    code: `def drive(x, z, seconds):
    motion.linear.x = x
    motion.angular.z = z
    wait(seconds)
    ${STOP}`,
  },
  stop: {
    code: `def stop():
    ${STOP}
    publisher.publish(motion)`,
  },
  wheels: {
    code: `def set_wheels(left, right):
    motion.linear.x = (left + right) / 2%speed
    motion.angular.z = (right - left) / %separation%speed`,
  },
  time: { code: "beginning = rospy.get_time()", start: ["beginning = rospy.get_time()"], global: ["beginning"] },
  here: {
    imports: ["import math", "from geometry_msgs.msg import Pose2D, Twist", "from nav_msgs.msg import Odometry"],
    code: `here = Pose2D()  # seen from where the program starts: m, m, rad
origin = []


def on_odom(message):
    position, rotation = message.pose.pose.position, message.pose.pose.orientation
    x, y, yaw = position.x, position.y, 2 * math.atan2(rotation.z, rotation.w)
    origin[:] = origin or (x, y, yaw)
    ahead, left, cosine, sine = x - origin[0], y - origin[1], math.cos(origin[2]), math.sin(origin[2])
    here.x, here.y = ahead * cosine + left * sine, left * cosine - ahead * sine
    here.theta = math.remainder(yaw - origin[2], math.tau)`,
    start: ['on_odom(rospy.wait_for_message("odom", Odometry, 5))', 'rospy.Subscriber("odom", Odometry, on_odom)'],
  },
  eyes: {
    imports: ["from std_msgs.msg import Float32MultiArray"],
    code: `eyes = [1, 1, 1]  # left, middle, right: 0 on a line


def on_line(message):
    eyes[:] = message.data`,
    start: ['on_line(rospy.wait_for_message("line", Float32MultiArray, 5))',
      'rospy.Subscriber("line", Float32MultiArray, on_line)'],
  },
  duties: {
    imports: ["from std_msgs.msg import Float32MultiArray"],
    code: `wheels = [0, 0]  # left, right: what they get


def on_wheels(message):
    wheels[:] = message.data[2:]`,
    start: ['rospy.Subscriber("jetbot_controller/wheels", Float32MultiArray, on_wheels)'],
  },
};

let needed = new Set();
let marked = []; // ids of blocks

function need(name) {
  for (const other of HELPERS[name].needs ?? []) need(other);
  needed.add(name);
}

const value = (block, name, order = Order.NONE) => python.valueToCode(block, name, order) || "0";
const index = (block, ...parts) => parts.indexOf(block.getFieldValue("WHAT"));

const ROBOT = {
  robot_start: () => "",
  robot_set: (block) => `motion.linear.x = ${value(block, "X")}\nmotion.angular.z = ${value(block, "Z")}\n`,
  robot_wheels(block) {
    need("wheels");
    return `set_wheels(${value(block, "LEFT")}, ${value(block, "RIGHT")})\n`;
  },
  robot_drive(block) {
    need("drive");
    return `drive(${value(block, "X")}, 0, ${value(block, "SECONDS")})\n`;
  },
  robot_turn(block) {
    need("drive");
    const right = block.getFieldValue("SIDE") === "RIGHT";
    const z = right ? `-${value(block, "Z", Order.UNARY_SIGN)}`.replace(/^--(?=[\d.]+$)/, "") : value(block, "Z");
    return `drive(0, ${z}, ${value(block, "SECONDS")})\n`;
  },
  robot_stop() {
    need("stop");
    return "stop()\n";
  },
  robot_wait(block) {
    need("wait");
    return `wait(${value(block, "SECONDS")})\n`;
  },
  robot_loop(block) {
    const end = TICK.map((line) => `${python.INDENT}${line}\n`).join("");
    return `while not rospy.is_shutdown():\n${python.statementToCode(block, "DO")}${end}`;
  },
  controls_flow_statements(block) {
    const flow = block.getFieldValue("FLOW").toLowerCase();
    let loop = block.getSurroundParent();
    while (loop && !LOOPS.includes(loop.type)) loop = loop.getSurroundParent();
    const before = flow === "continue" && loop?.type === "robot_loop" ? TICK : [];
    return [...before, flow].map((line) => `${line}\n`).join("");
  },
  robot_print: (block) => `print(${python.valueToCode(block, "VALUE", Order.NONE) || '""'})\n`,
  robot_here(block) {
    need("here");
    const part = ["here.x", "here.y", "math.degrees(here.theta)"][index(block, "X", "Y", "HEADING")];
    return [part, Order.FUNCTION_CALL];
  },
  robot_eye(block) {
    need("eyes");
    return [`eyes[${index(block, "LEFT", "MIDDLE", "RIGHT")}]`, Order.MEMBER];
  },
  robot_wheel(block) {
    need("duties");
    return [`wheels[${index(block, "LEFT", "RIGHT")}]`, Order.MEMBER];
  },
  robot_time() {
    need("time");
    return ["rospy.get_time() - beginning", Order.ADDITIVE];
  },
  math_change(block) {
    const name = python.getVariableName(block.getFieldValue("VAR"));
    return `${name} = ${name} + ${value(block, "DELTA", Order.ADDITIVE)}\n`;
  },
  procedures_callreturn(block) {
    const given = block.getVarModels().map((_, number) => value(block, `ARG${number}`));
    return [`${python.getProcedureName(block.getFieldValue("NAME"))}(${given.join(", ")})`, Order.FUNCTION_CALL];
  },
};

// Prepares Blockly's generator, once.
export function prepareGenerator() {
  Object.assign(python.forBlock, ROBOT);
  python.INDENT = "    ";
  python.addReservedWords("rospy,Twist,Pose2D,Odometry,Float32MultiArray,motion,publisher,rate,main,wait,drive,stop,"
    + "set_wheels,here,origin,on_odom,eyes,on_line,wheels,on_wheels,beginning");
  const { scrub_: scrub } = python;
  python.scrub_ = function mark(block, code, ...rest) {
    const marks = code && !block.outputConnection;
    return scrub.call(this, block, marks ? `#@${marked.push(block.id) - 1}\n${code}` : code, ...rest);
  };
}

// Returns { text, lines }: the node of this name, and the numbers of the lines by their blocks' ids, from 0.
// geometry: { wheel_separation, max_speed } of the robot
export function toPython(workspace, name, geometry) {
  [needed, marked] = [new Set(), []];
  python.init(workspace);
  const tops = workspace.getTopBlocks(true);
  for (const top of tops) if (top.type.startsWith("procedures_def")) python.blockToCode(top);
  const start = tops.find(({ type }) => type === "robot_start");
  const program = start ? python.blockToCode(start) : "";
  const definitions = Object.entries(python.definitions_);
  python.finish("");
  return separate(assemble(name, program, definitions, geometry).replace(ENDS, ""));
}

function assemble(name, program, definitions, geometry) {
  const variables = (definitions.find(([key]) => key === "variables")?.[1] ?? "").split("\n").filter(Boolean);
  const names = variables.map((line) => line.split(" ")[0]);
  const functions = definitions.filter(([key, code]) => key !== "variables" && !isImport(code)).map(([, code]) => code);
  const helpers = Object.keys(HELPERS).filter((key) => needed.has(key)).map((key) => HELPERS[key]);
  const own = names.filter((each) => new RegExp(`\\b${each} = |\\bfor ${each} in `).test(program));
  const globals = [...own, ...helpers.flatMap((helper) => helper.global ?? [])];
  const main = [...globals.length ? [`global ${globals.join(", ")}`] : [],
    "while publisher.get_num_connections() == 0:", `${python.INDENT}rate.sleep()`,
    ...helpers.flatMap((helper) => helper.start ?? [])].map((line) => `${python.INDENT}${line}\n`).join("");
  const head = [...HEAD.map((line) => line.replace("%", `"${name}"`)),
    ...variables.map((line) => line.replace(/None$/, "0"))].join("\n");
  const end = `${python.INDENT}publisher.publish(Twist())\n${python.INDENT}rate.sleep()`;
  const parts = [...helpers.map(({ code }) => adapt(code, geometry)), ...functions.map((code) => code.trim()),
    `def main():\n${main}${program && python.prefixLines(program, python.INDENT)}${end}`,
    "try:\n    main()\nexcept rospy.ROSInterruptException:\n    pass"];
  return `#!/usr/bin/env python3\n${imports(definitions, helpers)}\n\n${head}\n\n\n${parts.join("\n\n\n")}\n`;
}

const isImport = (code) => /^(import|from) /.test(code);

function imports(definitions, helpers) {
  const given = definitions.map(([, code]) => code).filter(isImport);
  const wanted = [...given, ...helpers.flatMap((each) => each.imports ?? [])];
  const twist = wanted.some((line) => line.includes("Twist")) ? [] : ["from geometry_msgs.msg import Twist"];
  const ours = (line) => /_msgs|rospy/.test(line);
  const all = [...new Set([...wanted, "import rospy", ...twist])];
  const sorted = (lines) => lines.sort((a, b) => a.startsWith("from") - b.startsWith("from") || (a < b ? -1 : 1));
  return [sorted(all.filter((line) => !ours(line))), sorted(all.filter(ours))].flat().join("\n");
}

function adapt(code, { wheel_separation: separation, max_speed: speed }) {
  return code.replaceAll("%speed", speed === 1 ? "" : ` * ${speed}`).replace("%separation", String(separation));
}

// Takes the marks out.
function separate(code) {
  const [text, lines] = [[], new Map()];
  for (const line of code.split("\n")) {
    const mark = MARK.exec(`${line}\n`);
    if (mark) lines.set(marked[mark[1]], text.length);
    else text.push(line);
  }
  return { text: text.join("\n"), lines };
}
