// The target that a precompiled header belongs to has a source.
int main() { return 0; }
