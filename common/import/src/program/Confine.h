#pragma once

namespace gnomon::importer {

/// From now on this process, and with it whoever takes it over by a model file, starts no program
/// and no process, makes no connection, and writes, removes or renames no file; what is open stays
/// open. For good. Does nothing where the kernel has no seccomp filters, or under a sanitizer.
/// False where nothing was done.
bool confineProcess();

}  // namespace gnomon::importer
