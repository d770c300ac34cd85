# Which systems have ROS 1, what MorBot needs there, and how to install it. Sourced by ./morbot.

# Packages to drive a robot, real or simulated; all packages, to build, test and draw too; what a camera needs.
run_packages="ros-environment rosbash python3-rospy python3-roslaunch python3-rostopic python3-rosnode python3-rosmsg
    python3-rosservice python3-rosparam python3-geometry-msgs python3-std-msgs python3-diagnostic-msgs
    python3-diagnostic-updater python3-nav-msgs python3-sensor-msgs python3-std-srvs python3-tf2-ros python3-tf2-msgs
    python3-visualization-msgs python3-rosbag ros-robot-state-publisher python3-smbus2 python3-serial python3-yaml
    python3-numpy python3-pil python3-tornado python3-segno python3-rosgraph python3-roslib python3-genpy python3-rospkg
    python3-catkin-pkg"
packages="$run_packages catkin make g++ librostest-dev libgeometry-msgs-dev ros-geometry-msgs ros-std-msgs
    python3-rostest python3-matplotlib python3-setuptools python3-pytest python3-pytest-xdist python3-hypothesis
    python3-pexpect iproute2 git"
camera_packages="gstreamer1.0-tools gstreamer1.0-plugins-base gstreamer1.0-plugins-good"

# A field of os-release(5); a derivative of Debian or Ubuntu names the release that it descends from.
os_release() {  # FIELD...
    for file in ${OS_RELEASE:-/etc/os-release /usr/lib/os-release}; do
        [ -r "$file" ] || continue
        for field; do echo "$(sed -n "s/^$field=//p" "$file" | tr -d "\r\"'")"; done
        return
    done
}

system_name() {
    name=$(os_release PRETTY_NAME)
    echo "${name:-$(uname -s)}"
}

# Whose packages of ROS 1 this system can install: debian (in Ubuntu's universe too), noetic, one (of ROS-O, where that
# is installed already) or none. A release that is not listed may have Debian's: then apt knows them.
ros_packages() {
    [ ! -f "$opt_ros/one/setup.sh" ] || { echo one; return; }
    case $(family) in
        debian | ubuntu) ;;
        *) echo none; return ;;
    esac
    case $(os_release UBUNTU_CODENAME DEBIAN_CODENAME VERSION_CODENAME | grep . | sed -n 1p) in
        bookworm | trixie | forky | jammy) echo debian ;;
        focal) echo noetic ;;
        *) if [ -z "$(missing_packages)" ] || is_known $packages; then echo debian; else echo none; fi ;;
    esac
}

# What this system descends from: ubuntu, debian, or something else.
family() {
    case " $(os_release ID ID_LIKE | tr '\n' ' ')" in
        *" ubuntu "*) echo ubuntu ;;
        *" debian "*) echo debian ;;
    esac
}

# Whether this system has ROS 1, or can install it; else why it cannot. The packages of ROS 2 exclude some.
has_ros() {
    ros=$(ros_packages)
    reason="$(system_name) has no packages of ROS 1"
    case $ros in
        noetic | one) packages=$(packages_of "$ros") ;;
        none) return 1 ;;
    esac
    missing=$(missing_packages)
    [ -n "$missing" ] || return 0
    is_known $missing || update_apt
    is_known $missing || fail "apt cannot find$(unknown_packages)$(source_advice)"
    reason="apt cannot install ROS 1 beside what is installed here, such as ROS 2"
    apt-get install --simulate -qq --no-install-recommends $missing >/dev/null 2>&1
}

update_apt() {  # one at a time: several shells may be opened at once
    as_root flock "$here" apt-get update -qq || fail "apt-get cannot reach its package sources (see above)"
}

is_installed() {
    environment
    source_ros
    reason="ROS 1 is not installed here"
    python3 -c "import rosgraph" 2>/dev/null
}

is_known() {
    apt-cache show "$@" >/dev/null 2>&1
}

missing_packages() {
    known=" $(dpkg-query -W -f '${Package}=${db:Status-Abbrev} ' $packages 2>/dev/null || :)"
    for package in $packages; do
        case $known in *" $package="?i*) ;; *) echo "$package" ;; esac
    done
}

# The same packages by their names in ROS Noetic on Ubuntu 20.04, where smbus2 and segno come from PyPI; or in ROS-O.
packages_of() {  # noetic | one
    for package in $packages; do
        case $package in
            python3-smbus2 | python3-segno) if [ "$1" = noetic ]; then echo python3-pip; else echo "$package"; fi ;;
            make | g++ | python3-serial | python3-yaml | python3-numpy | python3-pil | python3-tornado | \
                python3-matplotlib | python3-setuptools | python3-pytest* | python3-hypothesis | python3-pexpect | \
                iproute2 | git | gstreamer*) echo "$package" ;;
            ros-environment) echo "ros-$1-ros-environment" ;;
            *) echo "$package" | sed "s/^python3-//; s/^lib//; s/^ros-//; s/-dev$//; s/^/ros-$1-/" ;;
        esac
    done | sort -u
}

install_packages() {
    [ -z "$missing" ] || missing=$(missing_packages)  # as ``has_ros`` found it; another shell may have installed it since
    if [ -n "$missing" ]; then
        echo "morbot: installing" $missing
        update_apt
        as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends $missing ||
            fail "apt-get could not install these packages (see above)"
    fi
    [ "$ros" != noetic ] || python3 -c "import smbus2, segno" 2>/dev/null || as_root pip3 install -q smbus2 segno
}

unknown_packages() {
    for package in $missing; do
        is_known "$package" || printf ' %s' "$package"
    done
}

source_advice() {
    case $missing-$(family) in
        *ros-noetic-*) echo "; first add the source of ROS Noetic: http://wiki.ros.org/noetic/Installation/Ubuntu" ;;
        *-ubuntu) echo "; try: sudo add-apt-repository universe" ;;
    esac
}

as_root() {
    if [ "$(id -u)" = 0 ]; then "$@"; return; fi
    sudo true || fail "an administrator must run this once: sudo ${administration:-$here/morbot install}"
    sudo "$@"
}

# A minimal root file system has no /etc/hosts, and roslaunch does not start if localhost is unknown.
name_localhost() {
    getent hosts localhost >/dev/null || as_root sh -c 'echo 127.0.0.1 localhost >>/etc/hosts'
}
