//! Dispatch to the widest vectors of the processor.

use pulp::NullaryFnOnce;

/// Runs an operation as compiled for the widest vectors that this processor has: the same operations in the same order, so the same bits. A module
/// for browsers is compiled for its vectors as a whole, so it holds one copy of each operation instead of two.
#[inline]
pub(crate) fn widest<Op: NullaryFnOnce>(operation: Op) -> Op::Output {
    #[cfg(target_arch = "wasm32")]
    {
        operation.call()
    }
    #[cfg(not(target_arch = "wasm32"))]
    {
        pulp::Arch::new().dispatch(operation)
    }
}
