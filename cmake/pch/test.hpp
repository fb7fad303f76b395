// The same for tests.
#include "library.hpp"

#include <fstream>
#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>
#include <random>
#include <sstream>
