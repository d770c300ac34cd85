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
        --env JETBOT_CAMERA \
        "$container" "$here/docker/attend" $$ "$here/morbot" "$@"
}

# Prints the name of the running container; starts it, and before builds its image, if need be. Another device gives
# another name, so a container is added for what was plugged in; but a stop takes any that runs.
find_container() {
    : "${BASE:=$(base_image)}"
    image=morbot-system:$(cat "$here/docker/Dockerfile" "$here/setup/install.sh" | cksum | cut -d ' ' -f 1)-${BASE##*:}
    mkdir -p "$HOME/.ros"
    set -- --network host --pid host --security-opt label=disable --stop-timeout 30 \
        --volume "$here:$here" --tmpfs "$HOME:exec,mode=1777" --volume "$HOME/.ros:$HOME/.ros" \
        --env "HOME=$HOME" --env "USER=$(id -un)"
    set -- "$@" $(user_options)
    own=morbot-$(echo "$@" "$image" | cksum | cut -d ' ' -f 1)
    for device in $(devices); do
        set -- "$@" --device "$device" $(group_of "$device")
    done
    camera=$(jetson_camera)
    running=$([ "$command" != stop ] || "$tool" ps --filter "name=$own" --format '{{.Names}}')
    for container in $running "$own-$(echo "$@" "$camera" | cksum | cut -d ' ' -f 1)"; do
        ! "$tool" exec "$container" touch /tmp/last_use >/dev/null 2>&1 || { echo "$container"; return; }
    done
    "$tool" image inspect "$image" >/dev/null 2>&1 || build_system >&2
    start_container $camera "$@" || { [ -n "$camera" ] &&
        echo "morbot: $tool cannot give the Jetson's camera to the container (see above); trying without it" >&2 &&
        start_container "$@"; } || fail "$tool cannot start the container (see above)"
    echo "$container"
}

start_container() {  # OPTION...
    "$tool" rm "$container" >/dev/null 2>&1 || :  # left by a crash
    "$tool" run --detach --rm --name "$container" "$@" "$image" "$here/docker/attend" >/dev/null 9<&-
}

# The devices of motor boards and cameras; HOST_ROOT is for tests.
devices() {
    for kind in i2c- ttyACM ttyUSB video; do
        for device in "${HOST_ROOT:-}/dev/$kind"*; do
            [ ! -c "$device" ] || echo "$device"
        done
    done
}

# On a desktop, an access list lets a user open a camera, but docker copies only its group.
group_of() {  # DEVICE
    [ "$tool" != docker ] || ! [ -r "$1" ] || ! [ -w "$1" ] || echo "--group-add $(stat -L -c %g "$1")"
}

# The socket of the daemon that owns a Jetson's camera, and NVIDIA's libraries, which its container toolkit adds to any
# image. A daemon that restarts makes another socket: its inode gives the container another name.
jetson_camera() {
    socket=${HOST_ROOT:-}/tmp/argus_socket
    [ -S "$socket" ] || return 0
    case $("$tool" info --format '{{.Runtimes}}' 2>/dev/null) in
        *nvidia*) libraries="--runtime nvidia --env NVIDIA_VISIBLE_DEVICES=all --env NVIDIA_DRIVER_CAPABILITIES=all" ;;
        *) grep -qs nvidia.com/gpu "${HOST_ROOT:-}"/etc/cdi/* "${HOST_ROOT:-}"/run/cdi/* || return 0
            libraries="--device nvidia.com/gpu=all" ;;
    esac
    echo "$libraries --volume $socket:$socket --label argus=$(stat -c %i "$socket")"
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
    echo "morbot: building the image $image, once: it takes some minutes, the internet, and 1.5 GB"
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
