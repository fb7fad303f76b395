// stride-host: loads applications and runs them.
#include "runtime/host/host_main.hpp"

int main(int argc, char **argv) { return stride::host::hostMain(argc, argv, nullptr); }
