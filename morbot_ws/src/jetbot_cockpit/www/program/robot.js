// The robot's blocks: each row is how a block looks, with which numbers it lies in the toolbox, its Python, and what it
// does or reads in this page. Inputs and choices reach python() as code, does() and read() as values.

import { t } from "../language.js";
import { shown } from "./values.js";

const PLACE = { X: "here.x", Y: "here.y", HEADING: "math.degrees(here.theta)" };
const EYES = ["LEFT", "MIDDLE", "RIGHT"];
const SIDES = [[t("left"), "LEFT"], [t("right"), "RIGHT"]];
const WHEELS = SIDES.map(([, each]) => each);
const STANDING = [0, 0];
const SHORTEST = 5e-7; // s: what is shorter is none by a node's clock

const number = (name, ariaLabelText) => ({ type: "input_value", name, check: "Number", ariaLabelText });
const unitOf = (input) => ({ unit: input.getSourceBlock().getField(`UNIT_${input.name}`).getText() });
const X_INPUT = number("X", (input) => t("x in {unit}", unitOf(input)));
const Z_INPUT = number("Z", (input) => t("z in {unit}", unitOf(input)));
const SECONDS_INPUT = number("SECONDS", t("seconds"));
const unit = (name) => ({ type: "field_label", name: `UNIT_${name}`, text: "" });
const choice = (name, ariaTypeName, ...options) => ({ type: "field_dropdown", name, ariaTypeName, options });
const statement = { previousStatement: null, nextStatement: null };
const wait = (seconds) => (seconds >= SHORTEST ? [{ wait: seconds }] : []);
const drive = (motion, seconds) => [{ motion }, ...wait(seconds), { motion: STANDING }];

// does(): events of interpreter.js; needs: of helpers.js
export const DRIVE = [
  {
    type: "robot_set", message0: t("set x %1 %2 z %3 %4"),
    args0: [X_INPUT, unit("X"), Z_INPUT, unit("Z")],
    tooltip: t("x is forward, z to the left. In the workshop's units, 1 is full power: left = x − z, right = x + z. " +
      "The robot obeys while the program waits."), numbers: { X: 0.5, Z: 0.1 },
    python: ({ X, Z }) => (Z.includes("(") ? `motion.linear.x, motion.angular.z = ${X}, ${Z}` // Z may call what drives
      : `motion.linear.x = ${X}\nmotion.angular.z = ${Z}`),
    does: ({ X, Z }) => [{ motion: [X, Z] }],
  },
  {
    type: "robot_wheels", message0: t("set left wheel %1 power right wheel %2 power"),
    args0: [number("LEFT", t("left wheel in power")), number("RIGHT", t("right wheel in power"))],
    numbers: { LEFT: 0.4, RIGHT: 0.6 },
    tooltip: t("1 is full power forward, −1 backward. The robot obeys while the program waits."),
    python: ({ LEFT, RIGHT }) => `set_wheels(${LEFT}, ${RIGHT})`, needs: ["wheels"],
    does: ({ LEFT, RIGHT }, { wheel_separation: separation, max_speed: speed }) => [
      { motion: [(LEFT + RIGHT) / 2 * speed, (RIGHT - LEFT) / separation * speed] }],
  },
  {
    type: "robot_drive", message0: t("drive straight at x %1 %2 for %3 s"),
    args0: [X_INPUT, unit("X"), SECONDS_INPUT], numbers: { X: 0.5, SECONDS: 1 },
    tooltip: t("Drives forward, or backward if x is below 0, for so many seconds."),
    python: ({ X, SECONDS }) => `drive(${X}, 0, ${SECONDS})`, needs: ["wait", "drive"],
    does: ({ X, SECONDS }) => drive([X, 0], SECONDS),
  },
  {
    type: "robot_turn", message0: t("turn %1 at z %2 %3 for %4 s"),
    args0: [choice("SIDE", t("side"), ...SIDES), Z_INPUT, unit("Z"), SECONDS_INPUT], numbers: { Z: 0.2, SECONDS: 1 },
    tooltip: t("Turns on the spot for so many seconds."),
    python: ({ SIDE, Z, SECONDS }) => `drive(0, ${SIDE === "RIGHT" ? negative(Z) : Z}, ${SECONDS})`,
    needs: ["wait", "drive"],
    does: ({ SIDE, Z, SECONDS }) => drive([0, SIDE === "RIGHT" ? -Z : Z], SECONDS),
  },
  {
    type: "robot_stop", message0: t("stop"), tooltip: t("Stops the robot at once."),
    python: () => "stop()", needs: ["stop"],
    does: () => [{ motion: STANDING }, { publish: true }],
  },
  {
    type: "robot_wait", message0: t("wait %1 s"), args0: [SECONDS_INPUT], numbers: { SECONDS: 1 },
    tooltip: t("Repeats what was set, ten times per second, for so many seconds."),
    python: ({ SECONDS }) => `wait(${SECONDS})`, needs: ["wait"],
    does: ({ SECONDS }) => wait(SECONDS),
  },
].map((row) => ({ ...row, ...statement, colour: "#2f66c4", extensions: ["units"], inputsInline: true }));

// read() finds the value in what the robot senses; unknown: the sentence if it finds none
/** @type {any[]} */
export const SENSE = [
  {
    type: "robot_here", message0: t("%1 from the start"),
    args0: [choice("WHAT", t("place"), [t("x in m"), "X"], [t("y in m"), "Y"], [t("heading in degrees"), "HEADING"])],
    tooltip: t("Where the robot is, seen from where the program started: x ahead, y and heading to the left."),
    python: ({ WHAT }) => PLACE[WHAT], needs: ["here"],
    read: ({ WHAT }, { here }) => here?.[WHAT], unknown: t("This robot does not report where it is."),
  },
  {
    type: "robot_eye", message0: t("%1, 0 on a line"),
    args0: [choice("WHAT", t("eye"), [t("left eye"), "LEFT"], [t("middle eye"), "MIDDLE"], [t("right eye"), "RIGHT"])],
    tooltip: t("An eye of the line sensor: 0 on a dark line, 1 beside it."),
    python: ({ WHAT }) => `eyes[${EYES.indexOf(WHAT)}]`, needs: ["eyes"],
    read: ({ WHAT }, { line }) => line?.[EYES.indexOf(WHAT)],
    unknown: t("This robot does not report what its line sensor sees."),
  },
  {
    type: "robot_wheel", message0: t("%1 wheel in power"), args0: [choice("WHAT", t("wheel"), ...SIDES)],
    tooltip: t("What the wheel gets: 1 is full power forward."),
    python: ({ WHAT }) => `wheels[${WHEELS.indexOf(WHAT)}]`, needs: ["duties"],
    read: ({ WHAT }, { wheels }) => wheels?.[WHEELS.indexOf(WHAT)],
    unknown: t("This robot does not report its wheels."),
  },
  {
    type: "robot_time", message0: t("time in s"), tooltip: t("Seconds since the program started."),
    python: () => "seconds()", needs: ["seconds"],
    read: (_, { seconds }) => seconds,
  },
].map((row) => ({ ...row, output: "Number", colour: "#0d7264" }));

const OTHERS = [
  {
    type: "robot_start", message0: t("when the program starts"), nextStatement: null, colour: "#7a5200",
    tooltip: t("The blocks below run, one after the other. Blocks that hang nowhere do not."),
    python: () => "", does: () => [],
  },
  {
    type: "robot_loop", message0: t("repeat at 10 Hz %1 %2"), // semantics.js runs it
    args0: [{ type: "input_dummy" }, { type: "input_statement", name: "DO" }], ...statement,
    colour: "#3c7a1f", tooltip: t("Does this ten times per second, and repeats the command each time."),
    python: ({ DO }) => `while not rospy.is_shutdown():\n${DO}    publisher.publish(motion)\n    rate.sleep()`,
  },
  {
    type: "robot_print", message0: t("print %1"),
    args0: [{ type: "input_value", name: "VALUE", ariaLabelText: t("value to print") }], ...statement,
    colour: "#6a4fb5", tooltip: t("Shows a number or a text."),
    python: ({ VALUE }) => `print(${VALUE})`,
    does: ({ VALUE }) => [{ print: shown(VALUE) }],
  },
  {
    type: "robot_plot", message0: t("print %1 %2 as a curve"),
    args0: [{ type: "input_value", name: "NAME", ariaLabelText: t("name of the curve") },
      { type: "input_value", name: "VALUE", ariaLabelText: t("value to print") }], ...statement,
    colour: "#6a4fb5", inputsInline: true,
    tooltip: t("Prints a name and a value. Numbers also become a curve: press Curves."),
    python: ({ NAME, VALUE }) => `print(${NAME}, ${VALUE})`,
    does: ({ NAME, VALUE }) => [{ print: `${shown(NAME)} ${shown(VALUE)}`, name: shown(NAME), value: VALUE }],
  },
];

/** @type {any[]} */
export const ROBOT = [...DRIVE, ...SENSE, ...OTHERS];

function negative(code) {
  if (Number.isFinite(Number(code))) return String(-code);
  return /^\w+$/.test(code) ? `-${code}` : `-(${code})`;
}
