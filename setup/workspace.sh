# The environment of ROS and of this workspace; where and when it is built. Sourced by ./morbot; build.py builds.

home=${HOME:-/nonexistent}

# Debian's python3 must come first on PATH: ROS is installed for it, not for a pyenv, conda or virtual environment.
environment() {
    PATH=/usr/bin:/bin:/usr/sbin:/sbin:$PATH
    unset PYTHONHOME PYTHONPATH VIRTUAL_ENV PYTHONDONTWRITEBYTECODE PYTHONWARNINGS
    [ -n "${ROS_IP:-}" ] || : "${ROS_HOSTNAME:=localhost}"  # listen on the loopback interface alone
    ROS_ETC_DIR=$workspace/etc      # its roscore.xml does not start rosout, which listens on every interface
    : "${LANG:=C.UTF-8}"
    export CMAKE_POLICY_VERSION_MINIMUM=3.5  # CMake 4 refuses catkin's own files without it
    export PYTHONUNBUFFERED=1       # a node's output appears at once, through a pipe too
    export PATH ROS_HOSTNAME ROS_ETC_DIR LANG
    choose_ros_home
}

may_write() {
    for place; do
        [ -w "$place" ] || [ ! -e "$place" ] || return 1
    done
}

# Where ROS writes its logs, and the settings of the robot are. A root shell's ROS may have left ~/.ros to root.
choose_ros_home() {
    [ -z "${ROS_HOME:-}" ] || return 0
    for place in "$home/.ros" "$home/.ros/log"; do
        [ -d "$place" ] || [ ! -e "$place" ] && [ ! -L "$place" ] || {
            choose_cache
            export ROS_HOME="$cache/ros"
            echo "morbot: $place is no folder, so its settings are not used: mv $place $place.old" >&2
            return
        }
    done
    { [ -d "$home/.ros" ] || [ -w "$home" ]; } && may_write "$home/.ros" "$home/.ros/log" && return
    choose_cache
    export ROS_HOME="$cache/ros"
    [ ! -e "$home/.ros" ] || echo "morbot: you may not write to $home/.ros, so its settings are not used:" \
        "sudo chown -R $(id -un) $home/.ros" >&2
}

# The folder of a user who may not write to the usual ones.
choose_cache() {
    cache=${XDG_CACHE_HOME:-$home/.cache}/morbot
    mkdir -p "$cache" 2>/dev/null && [ -w "$cache" ] && return
    cache=${TMPDIR:-/tmp}/morbot-$(id -u)
    mkdir -p -m 700 "$cache" && [ -O "$cache" ] || [ "$command" = stop ] ||  # a stop needs no folder
        fail "cannot write to $cache: set XDG_CACHE_HOME to a folder of yours"
}

source_workspace() {
    [ -f "$1/setup.sh" ] || return 0
    etc=$ROS_ETC_DIR
    set +u
    . "$1/setup.sh"
    set -u
    export ROS_ETC_DIR="$etc"
}

# ROS's own, where it is not part of the system as Debian's is.
source_ros() {
    source_workspace "$opt_ros/one"
    source_workspace "$opt_ros/noetic"
}

# A user who may not write there uses the workspace's own build while it is up to date, or else one of their own.
choose_build() {
    build=$workspace/build devel=$workspace/devel
    if ! may_write "$workspace" "$workspace/src" "$build" "$devel" && ! is_built; then
        choose_cache
        build=$cache$workspace/build devel=$cache$workspace/devel
    fi
    [ -d "$build" ] || mkdir -p "$build"
}

# The files that catkin reads, and when each was last changed.
files() {
    find -L "$workspace/src" \( -name package.xml -o -name CMakeLists.txt -o -name setup.py \) \
        ! -path "$workspace/src/CMakeLists.txt" -printf '%p %C@\n' 2>/dev/null | sort
}

is_built() {  # a computer that loses its power leaves files empty
    [ -s "$devel/setup.sh" ] && files | cmp -s - "$devel/morbot.stamp"
}

# If the build fails, the last one stays in use. ./morbot setup also tries again what was left out.
build() {
    if is_built && { [ "$command" != setup ] || [ -z "$(left_out || :)" ]; }; then return; fi
    [ -s "$devel/setup.sh" ] || rm -f "$devel/morbot.stamp"
    [ -e "$workspace/src/CMakeLists.txt" ] || rm -f "$workspace/src/CMakeLists.txt"  # a link to another system's catkin
    if [ ! -e "$devel/morbot.stamp" ]; then rm -rf "$build"/*  # CMake does not continue what was interrupted
    elif ! grep -qF "$workspace/src/" "$devel/morbot.stamp"; then rm -rf "$build"/* "$devel"; fi  # the folder was moved
    rm -f "$devel/morbot.stamp"
    built=$(files)
    source=$workspace/src
    if [ ! -w "$source" ] && [ ! -e "$source/CMakeLists.txt" ]; then  # catkin puts that file there
        source=$build/../src
        mkdir -p "$source"
        ln -sfn "$workspace"/src/* "$source"
    fi
    if python3 "$here/setup/build.py" "$source" "$build" "$devel"; then
        sync -f "$devel" 2>/dev/null || :  # all else is on the disk before the stamp
        printf '%s\n' "$built" >"$devel/morbot.stamp"
    else
        [ "$command" != setup ] && [ -f "$devel/setup.sh" ] || exit 1
        echo "morbot: going on with the last build" >&2
    fi
}

# Why packages are left out, a line each.
left_out() {
    find -L "$workspace/src" -name CATKIN_IGNORE -exec grep -h '^morbot: ' {} + 2>/dev/null
}
