//! Dispatch to the widest vectors of the processor.

/// Runs an operation as compiled for the widest vectors that this processor has: the same operations in the same order, so the same bits. A module
/// for browsers is compiled for its vectors as a whole, so it holds one copy of each operation instead of two.
#[inline]
pub fn dispatch<Op: pulp::NullaryFnOnce>(operation: Op) -> Op::Output {
    #[cfg(target_arch = "wasm32")]
    {
        operation.call()
    }
    #[cfg(not(target_arch = "wasm32"))]
    {
        pulp::Arch::new().dispatch(operation)
    }
}

/// Defines functions that run with the widest vectors of the processor, by `internals::vectors::dispatch`. Generic parameters stand in brackets
/// behind the name.
///
/// Everything that the body calls has to be inlined, closures included: code of its own is compiled for the plain processor.
#[doc(hidden)]
#[macro_export]
macro_rules! widest {
    ($(
        $(#[$attribute:meta])*
        $visibility:vis fn $name:ident $([$($generic:tt)*])? ($($argument:ident: $type:ty),* $(,)?) $(-> $output:ty)? $body:block
    )*) => {$(
        $(#[$attribute])*
        $visibility fn $name $(<$($generic)*>)? ($($argument: $type),*) $(-> $output)? {
            struct Operation<T>(T);

            impl $(<$($generic)*>)? $crate::internals::vectors::NullaryFnOnce for Operation<($($type,)*)> {
                type Output = $crate::widest!(@output $($output)?);

                #[inline(always)]
                fn call(self) -> Self::Output {
                    let ($($argument,)*) = self.0;
                    $body
                }
            }

            $crate::internals::vectors::dispatch(Operation(($($argument,)*)))
        }
    )*};
    (@output) => { () };
    (@output $output:ty) => { $output };
}
