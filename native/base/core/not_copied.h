// Base of classes that can be neither copied nor moved.
#pragma once

namespace koebe {

struct NotCopied {
    NotCopied() = default;
    ~NotCopied() = default;
    NotCopied(const NotCopied&) = delete;
    NotCopied& operator=(const NotCopied&) = delete;
};

}  // namespace koebe
