// Tells the linker that the host answers this import (wasm/ts/host-kernels.ts); nothing of this file gets into the wasm.
mergeInto(LibraryManager.library, { hb_host_kernel: () => Number.NaN });
