/* What a library looks like that was built for another kernel. Its list must never be asked for. */
#include <stdlib.h>

const char* beadwork_stamp(void) { return "beadwork 0.0.1, another compiler"; }
const void* beadwork_plugins(void) { abort(); }
