/* A shared object without a program. */
int rung_test_nothing(void);
int rung_test_nothing(void) { return 0; }
