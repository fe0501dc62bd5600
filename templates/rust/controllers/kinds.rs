//! Enumerations.

use core::ops::{Index, IndexMut};

{%- for item in enums %}

{{ item.doc }}
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum {{ item.ty }} {
    {%- for member in item.members %}
    {{ member }},
    {%- endfor %}
}

impl {{ item.ty }} {
    pub const ALL: [Self; {{ item.members.len() }}] = [
        {%- for member in item.members %}
        Self::{{ member }},
        {%- endfor %}
    ];
    pub const COUNT: usize = Self::ALL.len();
}

impl<T, const N: usize> Index<{{ item.ty }}> for Array<T, N> {
    type Output = T;

    fn index(&self, index: {{ item.ty }}) -> &T {
        &self[index as i32]
    }
}

impl<T, const N: usize> IndexMut<{{ item.ty }}> for Array<T, N> {
    fn index_mut(&mut self, index: {{ item.ty }}) -> &mut T {
        &mut self[index as i32]
    }
}
{%- endfor %}
