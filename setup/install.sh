# What ROS and MorBot need on each system, and how to install it. Sourced by ./morbot.

# Packages to drive a robot, real or simulated; and all packages, to build, test and draw too.
run_packages="ros-environment rosbash python3-rospy python3-roslaunch python3-rostopic python3-rosnode python3-rosmsg
    python3-rosservice python3-rosparam python3-geometry-msgs python3-std-msgs python3-diagnostic-msgs
    python3-diagnostic-updater python3-nav-msgs python3-sensor-msgs python3-std-srvs python3-tf2-ros python3-rosbag
    ros-robot-state-publisher python3-smbus2 python3-serial python3-yaml
    python3-rosgraph python3-rospkg python3-catkin-pkg"
packages="$run_packages catkin make g++ librostest-dev libgeometry-msgs-dev ros-geometry-msgs ros-std-msgs
    python3-rostest python3-matplotlib python3-setuptools python3-pytest python3-pytest-xdist python3-pexpect iproute2
    git"

as_root() {
    if [ "$(id -u)" = 0 ]; then "$@"; return; fi
    command -v sudo >/dev/null || fail "run this once as root, or install sudo: $*"
    sudo "$@"
}

missing_packages() {
    for package in $packages; do
        dpkg-query -W -f '${db:Status-Abbrev}' "$package" 2>/dev/null | grep -q '^.i' || echo "$package"
    done
}

# The same packages by their names in ROS Noetic on Ubuntu 20.04. It has no smbus2, which comes from PyPI.
noetic_packages() {
    for package in $packages; do
        case $package in
            make | g++ | python3-serial | python3-yaml | python3-matplotlib | python3-setuptools | python3-pytest* | \
                python3-pexpect | iproute2 | git) echo "$package" ;;
            python3-smbus2) echo python3-pip ;;
            ros-environment) echo ros-noetic-ros-environment ;;
            *) echo "$package" | sed 's/^python3-//; s/^lib//; s/^ros-//; s/-dev$//; s/^/ros-noetic-/' ;;
        esac
    done | sort -u
}

install_packages() {
    ID='' VERSION_ID='' PRETTY_NAME="this system"
    os_release=${OS_RELEASE:-/etc/os-release}
    [ ! -r "$os_release" ] || . "$os_release"
    case "$ID $VERSION_ID" in
        "debian 12" | "debian 13" | "ubuntu 22.04" | "ubuntu 24.04") install_missing ;;
        "ubuntu 20.04")
            packages=$(noetic_packages)
            install_missing
            python3 -c "import smbus2" 2>/dev/null || as_root pip3 install -q smbus2 ;;
        *) fail "cannot set up $PRETTY_NAME. These Debian packages are needed:" $packages ;;
    esac
}

install_missing() {
    missing=$(missing_packages)
    [ -n "$missing" ] || return 0
    echo "morbot: installing" $missing
    as_root apt-get update -qq
    apt-cache show $missing >/dev/null 2>&1 || case $missing in
        *ros-noetic-*)
            fail "cannot find ROS Noetic. First add its source: http://wiki.ros.org/noetic/Installation/Ubuntu" ;;
        *) fail "cannot find all of these packages. On Ubuntu, try: sudo add-apt-repository universe" ;;
    esac
    as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing >/dev/null
}

# A minimal root file system has no /etc/hosts, and roslaunch does not start if localhost is unknown.
name_localhost() {
    getent hosts localhost >/dev/null || as_root sh -c 'echo 127.0.0.1 localhost >>/etc/hosts'
}
