// A test that needs what a machine may lack says so and is skipped; in CI, where all of it is to be there, it fails.
#pragma once
#include <gtest/gtest.h>

#include <cstdlib>

#define ISOSTAT_SKIP(why)                                                            \
  do {                                                                               \
    if (std::getenv("CI")) FAIL() << (why) << ": not to be skipped where CI is set"; \
    GTEST_SKIP() << (why);                                                           \
  } while (false)
