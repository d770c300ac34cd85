// The program as a catkin package: unpacked into morbot_ws/src and built with ./morbot setup, rosrun starts it.

import { archive } from "./archive.js";

const MODULES = ["rospy", "geometry_msgs", "nav_msgs", "sensor_msgs", "std_msgs"]; // that packages of ROS have
const INTERPRETER = "#!/usr/bin/env python3";
const SCRIPT = "program.py"; // not the program's name: a script random.py would be imported in place of Python's module

// Returns it as a text that unpacks itself. python: the script; program: the text that opens it again
export function packageText(name, python, program) {
  const script = python.startsWith("#!") ? python : `${INTERPRETER}\n${python}`;
  return archive(name, [
    { name: "package.xml", text: manifest(name, python) },
    { name: "CMakeLists.txt", text: cmake(name) },
    { name: `scripts/${SCRIPT}`, text: script, executable: true },
    { name: `launch/${name}.launch`, text: launch(name) },
    { name: `${name}.json`, text: program },
  ]);
}

function manifest(name, python) {
  const used = MODULES.filter((each) => python.includes(each));
  const depends = [...used, "jetbot_control_node"].map((each) => `  <exec_depend>${each}</exec_depend>\n`).join("");
  return `<?xml version="1.0"?>
<package format="3">
  <name>${name}</name>
  <version>0.0.1</version>
  <description>Drives a JetBot.</description>
  <maintainer email="me@example.com">Me</maintainer>
  <license>MIT</license>

  <buildtool_depend>catkin</buildtool_depend>
${depends}</package>
`;
}

function cmake(name) {
  return `cmake_minimum_required(VERSION 3.10)
project(${name})
find_package(catkin REQUIRED)
catkin_package()
catkin_install_python(PROGRAMS scripts/${SCRIPT}
  DESTINATION \${CATKIN_PACKAGE_BIN_DESTINATION})
install(DIRECTORY launch DESTINATION \${CATKIN_PACKAGE_SHARE_DESTINATION})
`;
}

function launch(name) {
  return `<launch>
  <include file="$(find jetbot_control_node)/launch/jetbot_controller.launch" pass_all_args="true"/>
  <node name="${name}" pkg="${name}" type="${SCRIPT}" output="screen"/>
</launch>
`;
}
