!=== logic_and
! rule: AND, OR, XOR and NOT take bool
! source: [K §3.11]
MODULE Demo
    VAR num n;
    VAR dnum d;
    VAR pos p;
    VAR string s;
    VAR orient o;
    VAR bool b;
    VAR pose f;
    PROC main()
        b := b AND n;  ! -> RG307
    ENDPROC
ENDMODULE
!=== logic_not
! rule: AND, OR, XOR and NOT take bool
! source: [K §3.11]
MODULE Demo
    VAR num n;
    VAR dnum d;
    VAR pos p;
    VAR string s;
    VAR orient o;
    VAR bool b;
    VAR pose f;
    PROC main()
        b := NOT n;  ! -> RG307
    ENDPROC
ENDMODULE
!=== logic_xor
! rule: AND, OR, XOR and NOT take bool
! source: [K §3.11]
MODULE Demo
    VAR num n;
    VAR dnum d;
    VAR pos p;
    VAR string s;
    VAR orient o;
    VAR bool b;
    VAR pose f;
    PROC main()
        b := s XOR b;  ! -> RG307
    ENDPROC
ENDMODULE
!=== long_constant_string
! rule: a string put together has at most 80 characters
! source: [K §2.13]
MODULE Demo
    VAR num n;
    VAR dnum d;
    VAR pos p;
    VAR string s;
    VAR orient o;
    VAR bool b;
    VAR pose f;
    PROC main()
        s := "xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx" + "yyyyyyyyyyyyyyyyyyyyyyyyyyyyyyy";  ! -> RG319
    ENDPROC
ENDMODULE
!=== missing_operand
! rule: an operator has its operands
! source: [K §3]
MODULE Demo
    VAR num n;
    VAR dnum d;
    VAR pos p;
    VAR string s;
    VAR orient o;
    VAR bool b;
    VAR pose f;
    PROC main()
        n := n + ;  ! -> RG201
    ENDPROC
ENDMODULE
!=== not_before_two_signs
! rule: behind a leading NOT one sign may stand, not two; a row of prefixes is reported once
! source: [K §3]
MODULE Demo
    VAR bool a;
    VAR num b;
    PROC main()
        a := NOT (- b < 1);
        a := NOT (- - b < 1);  ! -> RG212?
        a := NOT - b < 1;
        a := NOT - - b < 1;  ! -> RG212?
        b := - - - - b;  ! -> RG212?
    ENDPROC
ENDMODULE
!=== not_inside
! rule: NOT stands at the start of an expression
! source: [K §3] [code] 0 uses elsewhere
MODULE Demo
    VAR num n;
    VAR dnum d;
    VAR pos p;
    VAR string s;
    VAR orient o;
    VAR bool b;
    VAR pose f;
    PROC main()
        b := b AND NOT b;  ! -> RG212?
        b := b AND (NOT b);
    ENDPROC
ENDMODULE
!=== not_takes_ands
! rule: NOT takes everything up to OR or XOR
! source: [K §3]
MODULE Demo
    VAR num n;
    VAR dnum d;
    VAR pos p;
    VAR string s;
    VAR orient o;
    VAR bool b;
    VAR pose f;
    PROC main()
        b := NOT n = 1;
        b := NOT b AND b OR b;
    ENDPROC
ENDMODULE
!=== operands_equal_mixed
! rule: operands that no operator takes: equal_mixed
! source: [K §3.11]
MODULE Demo
    VAR num n;
    VAR dnum d;
    VAR pos p;
    VAR string s;
    VAR orient o;
    VAR bool b;
    VAR pose f;
    PROC main()
        b := n = s;  ! -> RG308
    ENDPROC
ENDMODULE
!=== operands_minus_string
! rule: operands that no operator takes: minus_string
! source: [K §3.11]
MODULE Demo
    VAR num n;
    VAR dnum d;
    VAR pos p;
    VAR string s;
    VAR orient o;
    VAR bool b;
    VAR pose f;
    PROC main()
        s := s - s;  ! -> RG308
    ENDPROC
ENDMODULE
!=== operands_num_dnum
! rule: operands that no operator takes: num_dnum
! source: [K §3.11]
MODULE Demo
    VAR num n;
    VAR dnum d;
    VAR pos p;
    VAR string s;
    VAR orient o;
    VAR bool b;
    VAR pose f;
    PROC main()
        d := n + d;  ! -> RG308
    ENDPROC
ENDMODULE
!=== operands_order_pos
! rule: operands that no operator takes: order_pos
! source: [K §3.11]
MODULE Demo
    VAR num n;
    VAR dnum d;
    VAR pos p;
    VAR string s;
    VAR orient o;
    VAR bool b;
    VAR pose f;
    PROC main()
        b := p < p;  ! -> RG308
    ENDPROC
ENDMODULE
!=== operands_order_string
! rule: operands that no operator takes: order_string
! source: [K §3.11]
MODULE Demo
    VAR num n;
    VAR dnum d;
    VAR pos p;
    VAR string s;
    VAR orient o;
    VAR bool b;
    VAR pose f;
    PROC main()
        b := s < s;  ! -> RG308
    ENDPROC
ENDMODULE
!=== operands_plus_mixed
! rule: operands that no operator takes: plus_mixed
! source: [K §3.11]
MODULE Demo
    VAR num n;
    VAR dnum d;
    VAR pos p;
    VAR string s;
    VAR orient o;
    VAR bool b;
    VAR pose f;
    PROC main()
        s := s + n;  ! -> RG308
    ENDPROC
ENDMODULE
!=== operands_pos_divide
! rule: a pos is divided by a num, nothing by a pos
! source: [backup] programs of a running cell with RobotWare 6.16; [K §3.11] has no such operator
MODULE Demo
    VAR num n;
    VAR dnum d;
    VAR pos p;
    VAR string s;
    VAR orient o;
    VAR bool b;
    VAR pose f;
    PROC main()
        p := (p + p) / 2;
        p := p / n;
        p := n / p;  ! -> RG308
        p := p / p;  ! -> RG308
    ENDPROC
ENDMODULE
!=== operands_pose_times
! rule: operands that no operator takes: pose_times
! source: [K §3.11]
MODULE Demo
    VAR num n;
    VAR dnum d;
    VAR pos p;
    VAR string s;
    VAR orient o;
    VAR bool b;
    VAR pose f;
    PROC main()
        f := f * f;  ! -> RG308
    ENDPROC
ENDMODULE
!=== operands_times_string
! rule: operands that no operator takes: times_string
! source: [K §3.11]
MODULE Demo
    VAR num n;
    VAR dnum d;
    VAR pos p;
    VAR string s;
    VAR orient o;
    VAR bool b;
    VAR pose f;
    PROC main()
        s := s * n;  ! -> RG308
    ENDPROC
ENDMODULE
!=== operands_unary
! rule: operands that no operator takes: unary
! source: [K §3.11]
MODULE Demo
    VAR num n;
    VAR dnum d;
    VAR pos p;
    VAR string s;
    VAR orient o;
    VAR bool b;
    VAR pose f;
    PROC main()
        s := -s;  ! -> RG308
    ENDPROC
ENDMODULE
!=== operator_div_mod
! rule: operands of div_mod
! source: [K §3.11]
MODULE Demo
    VAR num n;
    VAR dnum d;
    VAR pos p;
    VAR string s;
    VAR orient o;
    VAR bool b;
    VAR pose f;
    PROC main()
        n := n DIV n;
        n := n MOD n;
    ENDPROC
ENDMODULE
!=== operator_divide
! rule: operands of divide
! source: [K §3.11]
MODULE Demo
    VAR num n;
    VAR dnum d;
    VAR pos p;
    VAR string s;
    VAR orient o;
    VAR bool b;
    VAR pose f;
    PROC main()
        n := n / n;
        d := d / d;
    ENDPROC
ENDMODULE
!=== operator_equal
! rule: operands of equal
! source: [K §3.11]
MODULE Demo
    VAR num n;
    VAR dnum d;
    VAR pos p;
    VAR string s;
    VAR orient o;
    VAR bool b;
    VAR pose f;
    PROC main()
        b := n = n;
        b := s <> s;
        b := p = p;
        b := f <> f;
        b := b = b;
    ENDPROC
ENDMODULE
!=== operator_logic
! rule: operands of logic
! source: [K §3.11]
MODULE Demo
    VAR num n;
    VAR dnum d;
    VAR pos p;
    VAR string s;
    VAR orient o;
    VAR bool b;
    VAR pose f;
    PROC main()
        b := b AND b;
        b := b OR b;
        b := b XOR b;
        b := NOT b;
    ENDPROC
ENDMODULE
!=== operator_minus
! rule: operands of minus
! source: [K §3.11]
MODULE Demo
    VAR num n;
    VAR dnum d;
    VAR pos p;
    VAR string s;
    VAR orient o;
    VAR bool b;
    VAR pose f;
    PROC main()
        n := n - n;
        p := p - p;
        d := d - d;
    ENDPROC
ENDMODULE
!=== operator_order
! rule: operands of order
! source: [K §3.11]
MODULE Demo
    VAR num n;
    VAR dnum d;
    VAR pos p;
    VAR string s;
    VAR orient o;
    VAR bool b;
    VAR pose f;
    PROC main()
        b := n < n;
        b := n <= n;
        b := n > n;
        b := n >= n;
        b := d < d;
    ENDPROC
ENDMODULE
!=== operator_plus
! rule: operands of plus
! source: [K §3.11]
MODULE Demo
    VAR num n;
    VAR dnum d;
    VAR pos p;
    VAR string s;
    VAR orient o;
    VAR bool b;
    VAR pose f;
    PROC main()
        n := n + n;
        p := p + p;
        s := s + s;
        d := d + d;
    ENDPROC
ENDMODULE
!=== operator_times
! rule: operands of times
! source: [K §3.11]
MODULE Demo
    VAR num n;
    VAR dnum d;
    VAR pos p;
    VAR string s;
    VAR orient o;
    VAR bool b;
    VAR pose f;
    PROC main()
        n := n * n;
        p := n * p;
        p := p * n;
        p := p * p;
        o := o * o;
        d := d * d;
    ENDPROC
ENDMODULE
!=== operator_unary
! rule: operands of unary
! source: [K §3.11]
MODULE Demo
    VAR num n;
    VAR dnum d;
    VAR pos p;
    VAR string s;
    VAR orient o;
    VAR bool b;
    VAR pose f;
    PROC main()
        n := -n;
        p := -p;
        d := -d;
    ENDPROC
ENDMODULE
!=== primaries
! rule: literal, datum, call, aggregate, parentheses
! source: [K §3]
MODULE Demo
    VAR num n;
    VAR dnum d;
    VAR pos p;
    VAR string s;
    VAR orient o;
    VAR bool b;
    VAR pose f;
    PROC main()
        n := 1;
        n := n;
        n := Abs(n);
        p := [1, 2, 3];
        n := (n);
    ENDPROC
ENDMODULE
!=== relation_in_parentheses
! rule: parentheses start a new level
! source: [K §3]
MODULE Demo
    VAR num n;
    VAR dnum d;
    VAR pos p;
    VAR string s;
    VAR orient o;
    VAR bool b;
    VAR pose f;
    PROC main()
        b := (n < n) = b;
    ENDPROC
ENDMODULE
!=== relation_once
! rule: a relation takes part once a level
! source: [K §3]
MODULE Demo
    VAR num n;
    VAR dnum d;
    VAR pos p;
    VAR string s;
    VAR orient o;
    VAR bool b;
    VAR pose f;
    PROC main()
        b := n < n < n;  ! -> RG201
    ENDPROC
ENDMODULE
!=== sign_inside
! rule: a sign stands at the start of a sum
! source: [K §3] [code] 0 uses elsewhere
MODULE Demo
    VAR num n;
    VAR dnum d;
    VAR pos p;
    VAR string s;
    VAR orient o;
    VAR bool b;
    VAR pose f;
    PROC main()
        n := n * -n;  ! -> RG212?
        n := n + -n;  ! -> RG212?
        n := n * (-n);
    ENDPROC
ENDMODULE
