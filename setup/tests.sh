# Which tests run, and in which order. Sourced by ./morbot.

# Those in a browser come last and alone: it takes the computer's time, and some others measure motion by the clock.
run_tests() {
    cd "$here"
    [ $# = 0 ] || [ "$*" = --long ] || exec python3 -m pytest -n 8 "$@"
    failed=0
    part python3 -m pytest -n 8 "$@" tests/unit tests/ros
    part python3 -m pytest -n 3 "$@" tests/browser
    [ $# = 0 ] || part python3 -m pytest -n 0 tests/fleet
    [ $# = 0 ] || part python3 tests/chaos/chaos.py --rounds 200
    exit $failed
}

# Runs a part of the tests. After SIGTERM, or Ctrl-C, which the part gets, too, it cleans up, and no other part follows.
part() {
    "$@" &
    trap 'wait $! || :; exit 130' INT
    trap 'kill -TERM $!; wait $! || :; exit 143' TERM
    wait $! || failed=1
}
