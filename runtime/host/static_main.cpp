// The program of `stride build --static`: runs the application that is linked into it.
#include "runtime/host/host_main.hpp"

int main(int argc, char **argv) { return stride::host::hostMain(argc, argv, stride_app_v1()); }
