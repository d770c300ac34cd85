# How ./morbot runs in a container where the system has no packages of ROS 1. Sourced by ./morbot and docker/build.

# The first of these tools that works. On some systems, the command docker is podman.
working_tool() {
    for tool; do
        case $tool-$("$tool" --version 2>/dev/null) in
            *- | docker-podman*) continue ;;
        esac
        ! "$tool" ps >/dev/null 2>&1 || { echo "$tool"; return; }
    done
    return 1
}

# Where apt has it, and no container engine is installed; but nobody who wants to stop a robot waits for that.
install_podman() {  # COMMAND
    [ "$1" != stop ] && [ -n "$(family)" ] && [ -z "$(docker --version 2>/dev/null; podman --version 2>/dev/null)" ] ||
        return 1
    is_known podman || update_apt
    is_known podman || return 1
    echo "morbot: $reason; installing podman, to run in a container" >&2
    as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q podman >&2
}

build_image() {  # TARGET NAME
    # The OCI format has no health check; the images share layers.
    BUILDAH_FORMAT=docker BUILDAH_LAYERS=true "$tool" build --build-arg "BASE=$BASE" --target "$1" --tag "$2" \
        --file "$here/docker/Dockerfile" "$here"
}

# Runs a command of ./morbot in the container of this folder and user, which all their shells share.
in_container() {  # COMMAND...
    tool=$(working_tool docker podman) || { install_podman "$1" && tool=$(working_tool podman); } ||
        fail "$reason; $(container_advice)"
    echo "morbot: $reason; running in a container of $tool" >&2
    container=$(
        ! command -v flock >/dev/null || flock 9
        find_container
    ) 9<"$workspace" || exit 1
    folder=$(pwd -P)/
    case $folder in "$here"/*) ;; *) folder=$here ;; esac
    terminal=-i
    [ ! -t 0 ] || [ ! -t 1 ] || terminal=-it
    exec "$tool" exec $terminal --workdir "$folder" --env TERM --env ROS_MASTER_URI --env ROS_HOSTNAME --env ROS_IP \
        --env ROS_NAMESPACE --env JETBOT_BOARD --env JETBOT_I2C_BUS --env JETBOT_PORT \
        "$container" "$here/docker/attend" $$ "$here/morbot" "$@"
}

# Prints the name of the running container; starts it, and before builds its image, if need be.
find_container() {
    : "${BASE:=$(base_image)}"
    image=morbot-system:$(cat "$here/docker/Dockerfile" "$here/setup/install.sh" | cksum | cut -d ' ' -f 1)-${BASE##*:}
    mkdir -p "$HOME/.ros"
    set -- --network host --pid host --security-opt label=disable --stop-timeout 30 \
        --volume "$here:$here" --tmpfs "$HOME:exec,mode=1777" --volume "$HOME/.ros:$HOME/.ros" \
        --env "HOME=$HOME" --env "USER=$(id -un)"
    for device in /dev/i2c-* /dev/ttyACM* /dev/ttyUSB*; do
        [ ! -c "$device" ] || set -- "$@" --device "$device"
    done
    set -- "$@" $(user_options) "$image"
    container=morbot-$(echo "$@" | cksum | cut -d ' ' -f 1)
    ! "$tool" exec "$container" touch /tmp/last_use >/dev/null 2>&1 || { echo "$container"; return; }
    "$tool" image inspect "$image" >/dev/null 2>&1 || build_system >&2
    "$tool" rm "$container" >/dev/null 2>&1 || :  # left by a crash
    "$tool" run --detach --rm --name "$container" "$@" "$here/docker/attend" >/dev/null 9<&- ||
        fail "$tool cannot start the container (see above)"
    echo "$container"
}

# Gives processes in the container this user's files and groups. Docker's own limit on file descriptors is so high that
# roscore hangs.
user_options() {
    user="--user $(id -u):$(id -g)"
    limit="--ulimit nofile=1024:4096"
    case $tool-$(id -u) in
        podman-0) echo "$user" ;;
        podman-*) echo "$user --userns keep-id --group-add keep-groups" ;;
        *) case $(docker info --format '{{.SecurityOptions}}') in
            *rootless*) echo "$limit" ;;  # root there is this user
            *) echo "$user $limit --volume /etc/passwd:/etc/passwd:ro --security-opt apparmor=unconfined" \
                "$(id -G | sed 's/[0-9][0-9]*/--group-add &/g')" ;;
        esac ;;
    esac
}

build_system() {
    echo "morbot: building the image $image, once: it takes some minutes, the internet, and 1.4 GB"
    build_image system "$image" || fail "cannot build the image (see above); the first use needs the internet"
}

# JetPack 4 has a Docker that cannot start threads in images of newer releases than Ubuntu 20.04; later ones can.
base_image() {
    docker=$(docker version --format "{{.Server.Version}}" 2>/dev/null || :)
    oldest=$(printf '%s\n' 20.10.10 "$docker" | sort -V | head -n 1)
    if [ "$(os_release VERSION_CODENAME)" = bionic ] || { [ "$tool" = docker ] && [ "$oldest" != 20.10.10 ]; }; then
        echo docker.io/library/ros:noetic-ros-base-focal
    else
        echo docker.io/library/debian:bookworm-slim
    fi
}

container_advice() {
    case $(docker ps 2>&1)$(podman --version 2>/dev/null) in
        *"ermission denied"*)
            echo "docker is there, but closed to you: sudo usermod -aG docker $(id -un), and log in again" ;;
        *"daemon running"*) echo "docker is there, but not running: sudo systemctl enable --now docker" ;;
        *podman*) echo "podman is there, but does not work; see: podman ps" ;;
        *) echo "with docker or podman, it runs in a container: https://podman.io/docs/installation" ;;
    esac
}
