# The environment of ROS and of this workspace, for this user. Sourced by ./morbot.

# Debian's python3 must come first on PATH: ROS is installed for it, not for a pyenv, conda or virtual environment.
environment() {
    PATH=/usr/bin:/bin:/usr/sbin:/sbin:$PATH
    unset PYTHONHOME PYTHONPATH VIRTUAL_ENV PYTHONDONTWRITEBYTECODE
    [ -n "${ROS_IP:-}" ] || : "${ROS_HOSTNAME:=localhost}"  # listen on the loopback interface alone
    ROS_ETC_DIR=$workspace/etc      # its roscore.xml does not start rosout, which listens on every interface
    : "${LANG:=C.UTF-8}"
    export PYTHONUNBUFFERED=1       # a node's output appears at once, through a pipe too
    export PATH ROS_HOSTNAME ROS_ETC_DIR LANG
    choose_ros_home
    choose_master
}

home=${HOME:-/nonexistent}

# Where ROS writes its logs, and the settings of the robot are. A root shell's ROS may have left ~/.ros to root.
choose_ros_home() {
    [ -z "${ROS_HOME:-}" ] || return 0
    if [ -w "$home/.ros" ] || { [ ! -e "$home/.ros" ] && [ -w "$home" ]; }; then
        [ -w "$home/.ros/log" ] || [ ! -e "$home/.ros/log" ] || { choose_cache; export ROS_LOG_DIR="$cache/log"; }
        return
    fi
    choose_cache
    export ROS_HOME="$cache/ros"
    [ ! -e "$home/.ros" ] || echo "morbot: you may not write to $home/.ros, so its settings are not used:" \
        "sudo chown -R $(id -un) $home/.ros" >&2
}

# The folder of a user who may not write to the usual ones.
choose_cache() {
    cache=${XDG_CACHE_HOME:-$home/.cache}/morbot
    if [ -z "${XDG_CACHE_HOME:-}" ] && [ ! -d "$home" ]; then :
    elif mkdir -p "$cache" 2>/dev/null && [ -w "$cache" ]; then return; fi
    cache=${TMPDIR:-/tmp}/morbot-$(id -u)
    mkdir -p -m 700 "$cache" && [ -O "$cache" ] ||
        fail "cannot write to $cache: set XDG_CACHE_HOME to a folder of yours"
}

# Users of one computer have masters of their own: the port is ROS's for root and for the first user, and depends on
# the user's number for the others.
choose_master() {
    user=$(id -u)
    [ "$user" != 0 ] && [ "$user" != 1000 ] || return 0
    : "${ROS_MASTER_URI:=http://localhost:$((12000 + user % 20000))}"
    export ROS_MASTER_URI
}

source_workspace() {
    [ -f "$1/setup.sh" ] || return 0
    etc=$ROS_ETC_DIR
    set +u
    . "$1/setup.sh"
    set -u
    export ROS_ETC_DIR="$etc"
}
