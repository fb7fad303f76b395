// A shared object without the entry point of an application.
extern "C" __attribute__((visibility("default"))) int answer() { return 42; }
