#include "runtime/numeric/nc/sentence_queue.hpp"

namespace stride::nc {

bool frontSentence(const SentenceQueue &queue, SentenceHead &head) noexcept {
  if (queue.count > kQueueBytes || queue.read > queue.count ||
      queue.count - queue.read < sizeof head)
    return false;
  head = load<SentenceHead>(queue.bytes + queue.read);
  return head.size >= sizeof head && head.size <= queue.count - queue.read;
}

CodeWriter roomForSentence(SentenceQueue &queue, bool compact) noexcept {
  if (compact && queue.read > 0 && queue.read <= queue.count && queue.count <= kQueueBytes) {
    queue.count -= queue.read;
    __builtin_memmove(queue.bytes, queue.bytes + queue.read, queue.count);
    queue.read = 0;
    queue.whole = false;
  }
  return {queue.bytes + queue.count, static_cast<int32_t>(kQueueBytes - queue.count), 0};
}

void emptySentences(SentenceQueue &queue) noexcept {
  queue.read = queue.count = 0;
  queue.whole = false;
}

} // namespace stride::nc
