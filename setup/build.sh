# How the workspace is built. Sourced by ./morbot.

# Whether nothing that catkin reads has changed since the last build: package descriptions and the list of files.
is_built() {
    [ -f "$stamp" ] && [ -f "$workspace/devel/setup.sh" ] || return 1
    [ -z "$(find -L "$workspace/src" -name __pycache__ -prune -o -newer "$stamp" \
        \( -type d -o -name package.xml -o -name CMakeLists.txt -o -name setup.py \) -print)" ]
}

# A build made in another folder cannot be used.
build() {
    cache=$workspace/build/CMakeCache.txt
    stamp=$workspace/build/morbot.stamp
    if [ -f "$cache" ] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$workspace/src" "$cache"; then
        rm -rf "$workspace/build" "$workspace/devel"
    fi
    ! is_built || return 0
    mkdir -p "$workspace/build"
    log=$workspace/build/morbot.log
    catkin_make -C "$workspace" -DPYTHON_EXECUTABLE=/usr/bin/python3 >"$log" 2>&1 || {
        cat "$log"
        fail "the build failed"
    }
    touch "$stamp"
}
