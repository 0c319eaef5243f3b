#pragma once
// The kinds of plugins: in which section of a deck each stands, when it runs, and what it may change. A new kind is its
// class, a row of the table in plugin.hpp, and where it runs in stages a row of the one in core/loop/assembly.cpp.

#include "core/plugin/bond_law.hpp"
#include "core/plugin/contact_law.hpp"
#include "core/plugin/derived.hpp"
#include "core/plugin/failure.hpp"
#include "core/plugin/filler.hpp"
#include "core/plugin/load.hpp"
#include "core/plugin/mover.hpp"
#include "core/plugin/study.hpp"
#include "core/plugin/watcher.hpp"
