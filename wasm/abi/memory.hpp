// What a call does to older objects, for when memory runs out in it: see memory.cpp.
#pragma once

namespace handlebody {

/** The call makes something new and changes nothing else: all that it took can be freed. */
void making();

/** The call may change `owner`, which may hold what it took by then: that is kept until gone(owner). So it is, for good, where
 * neither is said. */
void changing(const void* owner);

/** After its destructor. */
void gone(const void* owner);

}  // namespace handlebody
