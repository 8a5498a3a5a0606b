// Puts the heap into large pages, if the system has them.
#pragma once

namespace koebe::cli {

/// Makes one heap for all threads, with room in large pages from the start. The system gives memory in pages of 4 kB
/// and takes freed memory back, again and again. Without this heap that would take a fifth of a map's time. No page is
/// touched before it is used. Where memory is limited, nothing changes. Call it before other threads start, and not
/// where many threads allocate at once: they would wait for each other.
void take_roomy_heap();

}  // namespace koebe::cli
