# For scripts/demo, bench and plots: runs the Python module $1 in the package's environment; in a checkout, builds what is missing before.
set -eo pipefail  # not -u: catkin reads unset variables
root=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../..")
setup=${MOCHA_BUILD:-$root/_build}/devel/setup.bash
enter() { . "$setup"; }  # a function, as catkin reads the arguments of the script that sources it

if [[ ! -x $root/scripts/build ]]; then
  PYTHONPATH=$root/mocha_ugv${PYTHONPATH:+:$PYTHONPATH} exec /usr/bin/python3 -m "$1" "${@:2}"
fi
if [[ " $* " != *" --help "* && " $* " != *" -h "* ]]; then "$root/scripts/build"; fi
export PATH=/usr/bin:/bin:/usr/sbin:/sbin
if [[ ! -x /usr/bin/python3 ]]; then "$root/scripts/setup"; fi
if [[ -f $setup ]]; then enter; fi
export PYTHONPATH=$root/scripts:$root/test${PYTHONPATH:+:$PYTHONPATH}
exec /usr/bin/python3 -m "$1" "${@:2}"
