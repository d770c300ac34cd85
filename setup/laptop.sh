# The teacher's computer: what a class of real robots needs there, without ROS. Sourced by ./morbot.

fleet_modules="tornado segno"
fleet_packages="python3-tornado python3-segno python3-zeroconf"

# Python with these modules: the system's, by apt where there is apt, or else a virtual environment in the cache.
choose_python() {
    environment
    python=python3
    ! has_modules || return 0
    if [ -n "$(family)" ]; then
        echo "morbot: installing $fleet_packages" >&2
        administration="apt install $fleet_packages"
        update_apt
        as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends $fleet_packages >&2
        has_modules || fail "apt-get could not install what a class of real robots needs (see above)"
        return
    fi
    choose_cache
    python=$cache/venv/bin/python
    ! has_modules || return 0
    echo "morbot: installing $fleet_modules and zeroconf into $cache/venv" >&2
    python3 -m venv "$cache/venv" && "$python" -m pip install -q $fleet_modules zeroconf >&2 && has_modules ||
        fail "Python could not install them (see above); the first use needs the internet"
}

has_modules() {
    "$python" -c "import $(echo "$fleet_modules" | sed 's/ /, /g')" 2>/dev/null
}

fleet() {
    choose_python
    exec "$python" "$workspace/src/jetbot_class/scripts/fleet.py" "$@"
}
