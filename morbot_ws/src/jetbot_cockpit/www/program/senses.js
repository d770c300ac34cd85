// What the robot senses while a program runs: the cockpit is asked for it, not too often.

const INTERVAL = 90; // ms between two questions
const TIMEOUT = 100; // ms for the answer

export class Senses {
  answer = {}; // the cockpit's last one
  askedAt = -Infinity;

  // needs: whether the program asks for { senses } at all, and for its { eyes }; ask(): asks the cockpit, whose answer
  // comes to receive()
  constructor({ senses, eyes }, ask) {
    this.ask = ask;
    this.used = senses;
    this.looks = eyes;
  }

  receive(answer) {
    this.answer = answer;
    this.answered?.();
  }

  // Asks again if the last question was long ago; returns whether it has asked.
  refresh() {
    if (performance.now() - this.askedAt < INTERVAL) return false;
    this.askedAt = performance.now();
    this.ask();
    return true;
  }

  async wait() {
    await new Promise((resolve) => {
      this.answered = () => resolve(null);
      setTimeout(resolve, TIMEOUT);
    });
  }

  // Whether the robot's controller is connected, and its sensors report: else the first command would arrive late.
  get complete() {
    return Boolean(this.answer.ready && (this.answer.line || !this.looks));
  }

  // The robot's place is seen from where it is now.
  begin() {
    this.origin = this.answer.pose;
  }

  // What the robot senses; what is not known is null or undefined.
  get values() {
    const { pose } = this.answer;
    return { ...this.answer, here: pose && this.origin && relative(pose, this.origin) };
  }
}

// Returns where a pose (m, m, rad) is as seen from another one: m ahead, m to the left, degrees to the left.
function relative([x, y, yaw], [fromX, fromY, fromYaw]) {
  const [ahead, left, turn] = [x - fromX, y - fromY, yaw - fromYaw];
  const [cosine, sine] = [Math.cos(fromYaw), Math.sin(fromYaw)];
  const heading = Math.atan2(Math.sin(turn), Math.cos(turn)) * 180 / Math.PI;
  return { X: ahead * cosine + left * sine, Y: left * cosine - ahead * sine, HEADING: heading };
}
