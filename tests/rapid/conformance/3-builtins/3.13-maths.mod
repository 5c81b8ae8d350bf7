!=== abs
! rule: arguments of Abs
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := Abs(1);
        r_num := Abs();  ! -> RG311
        r_num := Abs(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== absdnum
! rule: arguments of AbsDnum
! source: [manual] 3HAC050917
MODULE Demo
    VAR dnum r_dnum;
    PROC main()
        r_dnum := AbsDnum(1);
        r_dnum := AbsDnum();  ! -> RG311
        r_dnum := AbsDnum(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== acos
! rule: arguments of ACos
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := ACos(1);
        r_num := ACos();  ! -> RG311
        r_num := ACos(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== acosdnum
! rule: ACosDnum takes and gives dnum
! source: [manual] 3HAC050917, name; its argument as of ACos
MODULE Demo
    VAR dnum d;
    VAR num n;
    PROC main()
        d := ACosDnum(d);
        n := ACosDnum(d);  ! -> RG307
        d := ACosDnum(n);  ! -> RG307
        d := ACosDnum();  ! -> RG311
    ENDPROC
ENDMODULE
!=== add
! rule: arguments of Add
! source: [manual] 3HAC050917
MODULE Demo
    VAR dnum v_dnum;
    VAR num v_num;
    PROC main()
        Add v_num, 1;
        Add v_dnum, 1;
        Add v_num;  ! -> RG311
        Add v_num, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== asin
! rule: arguments of ASin
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := ASin(1);
        r_num := ASin();  ! -> RG311
        r_num := ASin(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== asindnum
! rule: ASinDnum takes and gives dnum
! source: [manual] 3HAC050917, name; its argument as of ASin
MODULE Demo
    VAR dnum d;
    VAR num n;
    PROC main()
        d := ASinDnum(d);
        n := ASinDnum(d);  ! -> RG307
        d := ASinDnum(n);  ! -> RG307
        d := ASinDnum();  ! -> RG311
    ENDPROC
ENDMODULE
!=== atan
! rule: arguments of ATan
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := ATan(1);
        r_num := ATan();  ! -> RG311
        r_num := ATan(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== atan2
! rule: arguments of ATan2
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := ATan2(1, 1);
        r_num := ATan2(1);  ! -> RG311
        r_num := ATan2(1, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== atan2dnum
! rule: ATan2Dnum takes and gives dnum
! source: [manual] 3HAC050917, name; its arguments as of ATan2
MODULE Demo
    VAR dnum d;
    VAR num n;
    PROC main()
        d := ATan2Dnum(d, d);
        n := ATan2Dnum(d, d);  ! -> RG307
        d := ATan2Dnum(d, n);  ! -> RG307
        d := ATan2Dnum(d);  ! -> RG311
    ENDPROC
ENDMODULE
!=== atandnum
! rule: ATanDnum takes and gives dnum
! source: [manual] 3HAC050917, name; its argument as of ATan
MODULE Demo
    VAR dnum d;
    VAR num n;
    PROC main()
        d := ATanDnum(d);
        n := ATanDnum(d);  ! -> RG307
        d := ATanDnum(n);  ! -> RG307
        d := ATanDnum();  ! -> RG311
    ENDPROC
ENDMODULE
!=== clear
! rule: arguments of Clear
! source: [manual] 3HAC050917
MODULE Demo
    VAR dnum v_dnum;
    VAR num v_num;
    PROC main()
        Clear v_num;
        Clear v_dnum;
        Clear;  ! -> RG311?
        Clear v_num \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== cos
! rule: arguments of Cos
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := Cos(1);
        r_num := Cos();  ! -> RG311
        r_num := Cos(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== cosdnum
! rule: CosDnum takes and gives dnum
! source: [manual] 3HAC050917, name; its argument as of Cos
MODULE Demo
    VAR dnum d;
    VAR num n;
    PROC main()
        d := CosDnum(d);
        n := CosDnum(d);  ! -> RG307
        d := CosDnum(n);  ! -> RG307
        d := CosDnum();  ! -> RG311
    ENDPROC
ENDMODULE
!=== decr
! rule: arguments of Decr
! source: [manual] 3HAC050917
MODULE Demo
    VAR dnum v_dnum;
    VAR num v_num;
    PROC main()
        Decr v_num;
        Decr v_dnum;
        Decr;  ! -> RG311?
        Decr v_num \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== dnumtonum
! rule: arguments of DnumToNum
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := DnumToNum(1);
        r_num := DnumToNum(1 \Integer);
        r_num := DnumToNum();  ! -> RG311
        r_num := DnumToNum(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== exp
! rule: arguments of Exp
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := Exp(1);
        r_num := Exp();  ! -> RG311
        r_num := Exp(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== incr
! rule: arguments of Incr
! source: [manual] 3HAC050917
MODULE Demo
    VAR dnum v_dnum;
    VAR num v_num;
    PROC main()
        Incr v_num;
        Incr v_dnum;
        Incr;  ! -> RG311?
        Incr v_num \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== max
! rule: arguments of Max
! source: [mem]
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := Max(1, 1);
        r_num := Max(1);  ! -> RG311
        r_num := Max(1, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== min
! rule: arguments of Min
! source: [mem]
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := Min(1, 1);
        r_num := Min(1);  ! -> RG311
        r_num := Min(1, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== numtodnum
! rule: arguments of NumToDnum
! source: [manual] 3HAC050917
MODULE Demo
    VAR dnum r_dnum;
    PROC main()
        r_dnum := NumToDnum(1);
        r_dnum := NumToDnum();  ! -> RG311
        r_dnum := NumToDnum(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== pow
! rule: arguments of Pow
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := Pow(1, 1);
        r_num := Pow(1);  ! -> RG311
        r_num := Pow(1, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== powdnum
! rule: PowDnum takes and gives dnum
! source: [manual] 3HAC050917, name; its arguments as of Pow
MODULE Demo
    VAR dnum d;
    VAR num n;
    PROC main()
        d := PowDnum(d, n);
        n := PowDnum(d, n);  ! -> RG307
        d := PowDnum(d, d);  ! -> RG307
        d := PowDnum(d);  ! -> RG311
    ENDPROC
ENDMODULE
!=== round
! rule: arguments of Round
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := Round(1);
        r_num := Round(1 \Dec:=1);
        r_num := Round();  ! -> RG311
        r_num := Round(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== rounddnum
! rule: arguments of RoundDnum
! source: [manual] 3HAC050917
MODULE Demo
    VAR dnum r_dnum;
    PROC main()
        r_dnum := RoundDnum(1);
        r_dnum := RoundDnum(1 \Dec:=1);
        r_dnum := RoundDnum();  ! -> RG311
        r_dnum := RoundDnum(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== sin
! rule: arguments of Sin
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := Sin(1);
        r_num := Sin();  ! -> RG311
        r_num := Sin(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== sindnum
! rule: SinDnum takes and gives dnum
! source: [manual] 3HAC050917, name; its argument as of Sin
MODULE Demo
    VAR dnum d;
    VAR num n;
    PROC main()
        d := SinDnum(d);
        n := SinDnum(d);  ! -> RG307
        d := SinDnum(n);  ! -> RG307
        d := SinDnum();  ! -> RG311
    ENDPROC
ENDMODULE
!=== sqrt
! rule: arguments of Sqrt
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := Sqrt(1);
        r_num := Sqrt();  ! -> RG311
        r_num := Sqrt(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== sqrtdnum
! rule: SqrtDnum takes and gives dnum
! source: [manual] 3HAC050917, name; its argument as of Sqrt
MODULE Demo
    VAR dnum d;
    VAR num n;
    PROC main()
        d := SqrtDnum(d);
        n := SqrtDnum(d);  ! -> RG307
        d := SqrtDnum(n);  ! -> RG307
        d := SqrtDnum();  ! -> RG311
    ENDPROC
ENDMODULE
!=== tan
! rule: arguments of Tan
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := Tan(1);
        r_num := Tan();  ! -> RG311
        r_num := Tan(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== tandnum
! rule: TanDnum takes and gives dnum
! source: [manual] 3HAC050917, name; its argument as of Tan
MODULE Demo
    VAR dnum d;
    VAR num n;
    PROC main()
        d := TanDnum(d);
        n := TanDnum(d);  ! -> RG307
        d := TanDnum(n);  ! -> RG307
        d := TanDnum();  ! -> RG311
    ENDPROC
ENDMODULE
!=== trunc
! rule: arguments of Trunc
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := Trunc(1);
        r_num := Trunc(1 \Dec:=1);
        r_num := Trunc();  ! -> RG311
        r_num := Trunc(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== truncdnum
! rule: TruncDnum takes and gives dnum
! source: [manual] 3HAC050917, name; its argument as of Trunc
MODULE Demo
    VAR dnum d;
    VAR num n;
    PROC main()
        d := TruncDnum(d);
        n := TruncDnum(d);  ! -> RG307
        d := TruncDnum(n);  ! -> RG307
        d := TruncDnum();  ! -> RG311
    ENDPROC
ENDMODULE
!=== tryint
! rule: arguments of TryInt
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        TryInt 1;
        TryInt;  ! -> RG311?
        TryInt 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
