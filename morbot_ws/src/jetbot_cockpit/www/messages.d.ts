// The messages of the cockpit's socket. Written by docs/messages.py: do not change it by hand.

export interface Said { code: string; arguments: Record<string, string | Said>; text: string; template: string; }
export interface Sentence { code: string; template: string; arguments: Record<string, string>; }
export interface Health { code: string; template: string; arguments: Record<string, string>; level: "ok" | "warning" | "bad"; }
export interface Driver { id: number; name: string; said: Said | null; }
export interface JudgedTask { name: string; title: string; state: "ready" | "driving" | "done" | "cancelled"; text: string; seconds: number | null; score: number | null; driver: string; request: string; sentences: Sentence[]; lost: number | null; }
export interface Pictures { free: number; blocked: number; problem: Said | null; }
export interface RobotState { status: string; state: "" | "driving" | "stopped" | "ended"; cause: string; template: string; arguments: Record<string, string>; remarks: Sentence[] | null; health: Health[] | null; holds: string[]; waiting: string[]; fake: boolean; warning: boolean; answers: boolean; stopped: boolean; pose: [number, number, number] | null; speed: [number, number] | null; command: [number, number] | null; wheels: [number, number] | null; program: string; driver: Driver | null; resumes: number | null; held: "robot" | "programs" | null; stalls: number; task: JudgedTask | null; pictures: Pictures | null; programs: number; link: number | null; }
export interface Robot { id: string; label: string; color: string; workshop: boolean | null; wheel_separation: number; max_speed: number; simulated: boolean; pupil: string; version: string; address: string; }
export interface Shape { kind: "wall" | "line" | "course" | "goal"; width: number; points: [number, number][]; }
export interface Score { task: string; robot: string; score: number; seconds: number | null; name: string; }
export interface Task { name: string; title: string; on: boolean; }
export interface Code { label: string; role: string; robot: string | null; url: string; code: string; rows: string[]; }
export interface Limits { name: number; program_name: number; program: number; message: number; rate: number; burst: number; trail: number; trail_step: number; wheel_separation: number; full_speed: number; }

export type Outgoing =
  | { type: "drive"; robot: string; forward: number; left: number; }
  | { type: "program"; robot: string; }
  | { type: "take"; robot: string; }
  | { type: "go_on"; robot?: string | null; }
  | { type: "stop"; robot?: string | null; }
  | { type: "release"; robot?: string | null; }
  | { type: "reset"; robot?: string | null; }
  | { type: "name"; name: string; }
  | { type: "pupil"; robot: string; name: string; }
  | { type: "ping"; sent: number; }
  | { type: "look"; robot?: string | null; }
  | { type: "seen"; number: number; }
  | { type: "curves"; robot?: string | null; eyes: boolean; }
  | { type: "save"; robot: string; label: "free" | "blocked"; }
  | { type: "delete"; robot: string; }
  | { type: "codes"; }
  | { type: "new_code"; robot?: string | null; }
  | { type: "judge"; robot: string; task: string; }
  | { type: "offer"; task: string; on: boolean; }
  | { type: "cameras"; on: boolean; };

export type Incoming =
  | { type: "hello"; id: number; name: string; role: "pupil" | "teacher"; robot: string | null; codes: boolean; limits: Limits; }
  | { type: "robots"; robots: Robot[]; }
  | { type: "state"; emergency: boolean; pupils_release: boolean; unconfirmed: string[]; robots: Record<string, RobotState>; }
  | { type: "trail"; robot: string; start: [number, number, number] | null; points: [number, number][]; }
  | { type: "scene"; robot: string; shapes: Shape[]; }
  | { type: "scores"; scores: Score[]; }
  | { type: "picture"; robot: string; number: number; stamp: number; bytes: number; }
  | { type: "curves"; robot: string; now: number; after: number; number: number; odom: [number, number, number, number, number, number][]; wheels: [number, number, number, number, number][]; line: [number, number, number, number][]; battery: [number, number][]; }
  | { type: "tasks"; tasks: Task[]; }
  | { type: "cameras"; on: boolean; }
  | { type: "notice"; code: string; arguments: Record<string, string | Said>; text: string; template: string; }
  | { type: "program"; robot: string; ready: boolean; pose: [number, number, number] | null; speed: [number, number] | null; line: [number, number, number] | null; command: [number, number] | null; wheels: [number, number] | null; }
  | { type: "lift"; robot: string; code: string; arguments: Record<string, string | Said>; text: string; template: string; }
  | { type: "judge"; robot: string; request: string; refusal: Said | null; }
  | { type: "pong"; sent: number; }
  | { type: "codes"; codes: Code[]; };

export type Request =
  | { do: "list"; robot?: string | null; }
  | { do: "open"; robot: string; id: string; version?: number | null; }
  | { do: "save"; robot: string; id: string; version: number; name: string; program: string; class?: string | null; }
  | { do: "delete"; robot: string; id: string; }
  | { do: "restore"; robot: string; id: string; };
