# What ./morbot fleet does on a robot. It comes over ssh each time, as the robot may have any version.
# Power may fail, and the connection end, at each line: "current" leads to a whole version, and typing it again heals.
set -eu
mkdir -p "$HOME/.local/share/morbot"
base=$(cd "$HOME/.local/share/morbot" && pwd -P)
repository=$base/repository versions=$base/versions current=$base/current
units="jetbot-guard.service jetbot.service"
needed=300  # MB for a version

fail() {
    echo "morbot: $*" >&2
    exit 1
}

as_root() {
    if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi
}

alone() {
    exec 9>"$base/lock"
    flock -n 9 || fail "another ./morbot fleet is at work on this robot"
}

# The repository that git pushes to; "again": the old one was damaged by a power cut.
receive() {  # [again]
    mkdir -p "$versions"
    alone
    command -v git >/dev/null || as_root apt-get install -y -q git || fail "git cannot be installed"
    [ "${1:-}" != again ] || rm -rf "$repository"
    make_repository 2>/dev/null || { rm -rf "$repository" && make_repository; }
}

make_repository() {
    git init -q --bare "$repository" && git --git-dir="$repository" config receive.shallowUpdate true &&
        git --git-dir="$repository" config receive.unpackLimit 1  # packs reach the disk, loose objects may not
}

# Builds a version in its folder; the file "whole" is written when all else is on the disk.
build() {  # COMMIT
    alone
    [ ! -e "$versions/$1/whole" ] || return 0
    rm -rf "${versions:?}/$1"
    free=$(($(df -Pk "$base" | awk 'NR == 2 { print $4 }') / 1024))
    [ "$free" -ge "$needed" ] || fail "only $free MB are free on this robot's disk, and a version needs $needed MB"
    mkdir "$versions/$1"
    if git --git-dir="$repository" archive "$1" | tar -x -C "$versions/$1" && "$versions/$1/morbot" setup 9>&-; then
        sync
        touch "$versions/$1/whole"
        sync
    else
        rm -rf "${versions:?}/$1"
        fail "the new version cannot be built on this robot"
    fi
}

# A robot on which the old version finds a fault too is not to blame on the new one.
check() {  # COMMIT
    found=$("$versions/$1/morbot" doctor 2>&1) || ! "$current/morbot" doctor >/dev/null 2>&1 || {
        echo "$found" >&2
        fail "the new version's doctor finds a fault that the old one's does not (see above)"
    }
}

link() {  # FOLDER NAME
    ln -sfn "$1" "$2.new"
    mv -T "$2.new" "$2"
    sync
}

# systemd's files are those of the version that runs; one from before --files keeps them.
write_files() {
    "$current/morbot" robot --files 9>&- || echo "morbot: this version keeps the service's files as they are" >&2
}

restart() {
    as_root systemctl restart $units 9>&-
}

# Lets a version run from now on. RUNNING: the commit that answers, which need not be what "current" leads to: one that
# has never answered is not what to go back to.
switch() {  # COMMIT [RUNNING]
    alone
    [ -e "$versions/$1/whole" ] || fail "the new version is not whole"
    before=$(readlink "$current") || fail "this robot was not set up by ./morbot robot: ./morbot fleet add does that"
    if [ "$before" != "$versions/$1" ]; then
        [ "$before" != "$versions/${2:-}" ] && [ -e "$base/previous/whole" ] || link "$before" "$base/previous"
        link "$versions/$1" "$current"
    fi
    write_files
    [ "${2:-}" = "$1" ] || restart
}

back() {
    alone
    before=$(readlink "$base/previous") || fail "there is no version to go back to"
    link "$before" "$current"
    write_files
    restart
}

# Keeps two versions.
tidy() {
    alone
    for version in "$versions"/*; do
        case $version in "$(readlink -f "$current")" | "$(readlink -f "$base/previous")") continue ;; esac
        rm -f "$version/whole"
        rm -rf "$version"
    done
}

save_key() {
    umask 077
    cat >"$base/key"
}

# The key comes in a file: sudo may ask for a password at the terminal.
name() {  # COMMIT ROBOT CLASS ARGUMENT...
    commit=$1 robot=$2 class=$3
    shift 3
    trap 'rm -f "$base/key"' EXIT
    "$versions/$commit/morbot" robot "$robot" --class "$class" "$@" <"$base/key"
}

# The link is the last to go: without it, all is undone.
off() {
    [ -e "$current/morbot" ] || return 0
    "$current/morbot" robot --off --forget
}

log() {  # ARGUMENT...
    units=$(printf -- '-u %s ' $units)
    case " $(id -nG) " in
        *" root "* | *" adm "* | *" systemd-journal "*) journalctl $units --no-pager "$@" ;;
        *) sudo journalctl $units --no-pager "$@" ;;
    esac
}

"$@"
