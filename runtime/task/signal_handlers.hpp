// The handlers of the process for invalid memory accesses.
#ifndef STRIDE_RUNTIME_TASK_SIGNAL_HANDLERS_HPP
#define STRIDE_RUNTIME_TASK_SIGNAL_HANDLERS_HPP

namespace stride::task {

/// Installs them, if they are not; the last releaseSignalHandlers puts the earlier ones back. They
/// end the guardedCall of the thread, and without one the process (endBySignal).
void useSignalHandlers();
void releaseSignalHandlers();

} // namespace stride::task

#endif
