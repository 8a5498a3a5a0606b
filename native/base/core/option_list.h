// Lists the options of a struct. The command's flags, the reports and the Python binding are made of the list.
//
// A struct of options has a function each_option(visit) that calls visit(name, pointer to member) for each option, in
// the order of the help.
#pragma once

/// Calls visit for these members of a type. At most 30.
#define KOEBE_VISIT(type, ...) KOEBE_EXPAND(KOEBE_VISIT_FIRST(type, __VA_ARGS__))

/// Defines each_option of a struct without bases.
#define KOEBE_OPTIONS(type, ...)                                                                                       \
    template <typename Visit>                                                                                          \
    static void each_option(Visit&& visit)                                                                             \
    {                                                                                                                  \
        KOEBE_VISIT(type, __VA_ARGS__)                                                                                 \
    }

/// Defines each_option of a struct over a base: its own options, then the base's.
#define KOEBE_OPTIONS_OVER(base, type, ...)                                                                            \
    template <typename Visit>                                                                                          \
    static void each_option(Visit&& visit)                                                                             \
    {                                                                                                                  \
        KOEBE_VISIT(type, __VA_ARGS__)                                                                                 \
        base::each_option(visit);                                                                                      \
    }

// Visits the first member. The rest is left to the next expansion.
#define KOEBE_VISIT_FIRST(type, name, ...)                                                                             \
    visit(#name, &type::name);                                                                                         \
    __VA_OPT__(KOEBE_VISIT_AGAIN KOEBE_NO_ARGUMENTS(type, __VA_ARGS__))
#define KOEBE_VISIT_AGAIN() KOEBE_VISIT_FIRST
#define KOEBE_NO_ARGUMENTS ()
#define KOEBE_EXPAND(...) KOEBE_EXPAND_16(KOEBE_EXPAND_16(KOEBE_EXPAND_16(__VA_ARGS__)))
#define KOEBE_EXPAND_16(...) KOEBE_EXPAND_4(KOEBE_EXPAND_4(KOEBE_EXPAND_4(__VA_ARGS__)))
#define KOEBE_EXPAND_4(...) KOEBE_EXPAND_1(KOEBE_EXPAND_1(__VA_ARGS__))
#define KOEBE_EXPAND_1(...) __VA_ARGS__
