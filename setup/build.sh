# Where the workspace is built, and when. Sourced by ./morbot; build.py builds.

# A user who may not write there uses the workspace's own build while it is up to date, or else one of their own.
choose_build() {
    build=$workspace/build devel=$workspace/devel
    if ! may_write "$workspace" "$workspace/src" "$build" "$devel" "$build/CMakeCache.txt" "$devel/setup.sh"; then
        [ -r "$build" ] && is_built && return  # readable: the lock is there
        choose_cache
        build=$cache$workspace/build devel=$cache$workspace/devel
    fi
    [ -d "$build" ] || mkdir -p "$build" || exit 1
}

may_write() {
    for place; do
        [ -w "$place" ] || [ ! -e "$place" ] || return 1
    done
}

# Whether nothing that catkin reads has changed since the last build: package descriptions and the list of files.
is_built() {
    stamp=$devel/morbot.stamp
    [ -f "$devel/setup.sh" ] && [ -s "$stamp" ] && is_built_here || return 1
    [ -z "$(find -L "$workspace/src" -name __pycache__ -prune -o -cnewer "$stamp" \
        \( -type d -o -name package.xml -o -name CMakeLists.txt -o -name setup.py \) -print 2>/dev/null)" ]
}

# A build made in another folder cannot be used.
is_built_here() {
    read -r source <"$stamp" || return 1
    [ "$source" = "$workspace/src" ] || [ "$source" = "$build/view/src" ]
}

# If the build fails, the last one stays in use.
build() {
    ! is_built || return 0
    [ ! -s "$stamp" ] || is_built_here || rm -rf "$build"/* "$devel"
    in_python build.py "$workspace/src" "$build" "$devel" && return
    [ "$command" != setup ] && [ -f "$devel/setup.sh" ] || exit 1
    echo "morbot: going on with the last build" >&2
}

# Whatever was built last, and a search path without the packages that ROS cannot read now.
source_last_build() {
    choose_build
    [ -f "$devel/setup.sh" ] || devel=$workspace/devel
    [ ! -w "$devel" ] || in_python refresh.py "$workspace/src" "$devel" || :
    source_workspace "$devel"
}

in_python() {  # SCRIPT ARGUMENTS...
    script=$1
    shift
    PYTHONPATH=$workspace/src/jetbot/src:$workspace/src/jetbot_ros/src:$workspace/src/jetbot_control_node/src:$workspace/src/jetbot_tools/src python3 "$here/setup/$script" "$@"
}

# ./morbot setup tries again what failed: its cause may be outside of the workspace.
forget_problems() {
    [ ! -s "$devel/morbot.problems" ] || touch -t 197001010000 "$devel/morbot.stamp" 2>/dev/null || :
}

report_problems() {
    [ -s "$devel/morbot.problems" ] || return 0
    cat "$devel/morbot.problems" >&2
    [ "$command" != setup ] || fail "everything else is ready"
}

wait_for_other_builds() {
    if flock -n 9 2>/dev/null || [ $? != 1 ]; then return; fi  # a network drive may know no locks
    echo "morbot: waiting for another ./morbot in this folder" >&2
    flock 9
}
