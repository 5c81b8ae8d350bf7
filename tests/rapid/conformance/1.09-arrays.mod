!=== aggregate_of_other_size
! rule: an aggregate has a member for each element of the array
! source: [K §2.17, 3.9]
MODULE Demo
    VAR num a{2};
    VAR num b{2,3};
    PROC main()
        a := [1, 2];
        a := [1, 2, 3];  ! -> RG318
        b := [[1, 2, 3], [4, 5, 6]];
        b := [[1, 2], [3, 4]];  ! -> RG318 RG318
    ENDPROC
ENDMODULE
!=== comparison
! rule: whole arrays of one size can be compared
! source: [K §2.17, 3.11]
MODULE Demo
    VAR num a{2};
    VAR num b{2};
    VAR num c{3};
    VAR bool same;
    PROC main()
        same := a = b;
        same := a <> b;
        same := a = [1, 2];
        same := a = c;  ! -> RG318
        same := a = [1, 2, 3];  ! -> RG318
        same := a = 1;  ! -> RG308
    ENDPROC
ENDMODULE
!=== component_of_call
! rule: a call has no component
! source: [K §3]
MODULE Demo
    VAR num a;
    PROC main()
        a := CPos().x;  ! -> RG201
    ENDPROC
ENDMODULE
!=== components_of_element
! rule: components behind an element, and chains
! source: [K §3.5]
MODULE Demo
    VAR pose a{2};
    VAR num b;
    PROC main()
        a{2}.trans.x := 1;
        b := a{1}.rot.q1;
    ENDPROC
ENDMODULE
!=== different_degree
! rule: arrays of different degree are not assigned
! source: [K §2.17]
MODULE Demo
    VAR num a{3};
    VAR num b{3, 3};
    PROC main()
        a := b;  ! -> RG307
    ENDPROC
ENDMODULE
!=== different_size
! rule: arrays of different size are not assigned
! source: [K §2.17]
MODULE Demo
    VAR num a{3};
    VAR num b{4};
    PROC main()
        a := b;  ! -> RG318
    ENDPROC
ENDMODULE
!=== formal_array
! rule: an array parameter takes any size of its degree
! source: [K §5.1]
MODULE Demo
    VAR num a{2};
    VAR num b{9};
    VAR num c{2, 2};
    PROC main()
        sum a;
        sum b;
        sum c;  ! -> RG307
    ENDPROC
    PROC sum(num v{*})
        TPWrite "" \Num:=Dim(v, 1) + v{1};
    ENDPROC
ENDMODULE
!=== formal_array_sizes
! rule: a parameter has stars for sizes
! source: [K §5.1]
MODULE Demo
    PROC main()
    ENDPROC
    PROC p(num v{3})  ! -> RG201
    ENDPROC
ENDMODULE
!=== index_behind_component
! rule: only a whole datum has indices
! source: [K §3.5]
MODULE Demo
    VAR num a;
    VAR pos p;
    PROC main()
        a := p.x{1};  ! -> RG201
    ENDPROC
ENDMODULE
!=== index_fraction
! rule: an index is whole
! source: [K §3.5]; loaded as behind the end (index_too_large): the error comes when it is executed
MODULE Demo
    VAR num a{3};
    PROC main()
        a{1.5} := 1;  ! -> RG318?
    ENDPROC
ENDMODULE
!=== index_of_scalar
! rule: a scalar has no elements
! source: [K §3.5]
MODULE Demo
    VAR num a;
    PROC main()
        a{1} := 1;  ! -> RG318
    ENDPROC
ENDMODULE
!=== index_too_large
! rule: an index lies within the size
! source: [K §3.5]; loaded: Utility.sys in backups of two IRB 120 (RobotWare 5.15)
MODULE Demo
    CONST num n := 3;
    VAR num a{n};
    PROC main()
        a{n + 1} := 1;  ! -> RG318?
    ENDPROC
ENDMODULE
!=== index_type
! rule: an index is num
! source: [K §3.5]
MODULE Demo
    VAR num a{3};
    PROC main()
        a{"1"} := 1;  ! -> RG307
    ENDPROC
ENDMODULE
!=== index_zero
! rule: indices start from 1
! source: [K §3.5]; loaded as behind the end (index_too_large): the error comes when it is executed
MODULE Demo
    VAR num a{3};
    PROC main()
        a{0} := 1;  ! -> RG318?
    ENDPROC
ENDMODULE
!=== no_operator
! rule: no other operator takes arrays
! source: [K §3.11]
MODULE Demo
    VAR num a{3};
    PROC main()
        a := a + a;  ! -> RG308
    ENDPROC
ENDMODULE
!=== no_slice
! rule: an element is named with all its indices
! source: [K §3.5]
MODULE Demo
    VAR num a{3, 3};
    VAR num b{3};
    PROC main()
        b := a{1};  ! -> RG318
    ENDPROC
ENDMODULE
!=== whole_assignment
! rule: whole arrays of equal shape are assigned and compared
! source: [K §2.17, 3.11]
MODULE Demo
    VAR num a{3};
    VAR num b{3};
    PROC main()
        a := b;
        IF a = b AND a <> b a := b;
    ENDPROC
ENDMODULE
