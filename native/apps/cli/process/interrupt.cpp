#include "cli/process/interrupt.h"

#include <csignal>

namespace koebe::cli {
namespace {

CancelToken* signalled = nullptr;  // for the signal handler; its flag is lock-free

void raise_token(int) { signalled->cancel(); }

}  // namespace

CancelToken cancel_on_signal()
{
    static CancelToken token;
    signalled = &token;
#if defined(_WIN32)
    for (const int signal : {SIGINT, SIGTERM, SIGBREAK}) std::signal(signal, raise_token);  // only for the first
#else
    struct sigaction action {};
    action.sa_handler = raise_token;
    action.sa_flags = SA_RESETHAND | SA_RESTART;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction old {};
        sigaction(signal, nullptr, &old);
        if (old.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);  // keeps nohup's choice
    }
    for (const int signal : {SIGXFSZ, SIGPIPE}) std::signal(signal, SIG_IGN);
#endif
    return token;
}

}  // namespace koebe::cli
