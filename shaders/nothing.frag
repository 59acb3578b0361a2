// For passes that only count which pixels pass the tests.

void main() {}
